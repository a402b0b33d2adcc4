#include "morsel/tools/reproduce/figure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/formats/png_comment.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/render/caption.h"
#include "morsel/tools/render/request_words.h"
#include "morsel/tools/render/sheet.h"
#include "morsel/tools/report/request_words.h"
#include "morsel/tools/reproduce/region.h"
#include "morsel/tools/study/hierarchy.h"

namespace morsel::tools::reproduce {
namespace {

using render::Show;

// The least cosine between normal and line of sight at which one can look into a region.
constexpr double kFacing = 0.7;
constexpr core::Length kRegion = core::Length::epsilons(8);  // σ, the radius of smoothing

std::string letter(std::size_t panel) { return {static_cast<char>('a' + panel)}; }

/// The text with "{c}" replaced by the number of critical points of panel (c).
std::string resolved(std::string_view method, const FigureRecipe& recipe, Model& model,
                     const core::Progress& progress) {
  std::string text(method);
  for (std::size_t i = 0; i < recipe.panels.size(); ++i) {
    const std::string reference = "{" + letter(i) + "}";
    const std::size_t at = text.find(reference);
    if (at == std::string::npos) continue;
    const std::string other = resolved(recipe.panels[i].method, recipe, model, progress);
    text.replace(at, reference.size(),
                 std::to_string(model.run({std::string(recipe.field), other}, progress).total()));
  }
  return text;
}

/// Away from zero, to two digits: short in commands and on colour bars.
double rounded_out(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const int digits = 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  // Powers of ten with positive exponents are exact, so that the quotient is the nearest to the decimal
  // number.
  const double power = std::pow(10, std::abs(digits));
  const double scaled = digits >= 0 ? std::abs(value) * power : std::abs(value) / power;
  const double whole = std::ceil(scaled * (1 - 1e-12));
  return std::copysign(digits >= 0 ? whole / power : whole * power, value);
}

/// The colours of panels that share a range: from the lowest lower end to the highest upper one.
class SharedScales {
 public:
  void add(const PanelRecipe& panel, const core::ScalarField& field) {
    if (panel.scale.empty() || panel.show != Show::field) return;
    const ValueScale scale = choose_scale(field.values());
    const auto [place, is_new] = requests_.try_emplace(panel.scale);
    ScaleRequest& request = place->second;
    if (is_new) {
      request.limits = {scale.low, scale.high};
      request.colormap = scale.map.name();
    }
    request.limits = {rounded_out(std::min(request.limits->first, scale.low)),
                      rounded_out(std::max(request.limits->second, scale.high))};
  }
  ScaleRequest of(const PanelRecipe& panel) const {
    const auto found = requests_.find(panel.scale);
    return found == requests_.end() || panel.show != Show::field ? ScaleRequest{} : found->second;
  }

 private:
  std::map<std::string_view, ScaleRequest> requests_;
};

/// The arguments of `morsel render` that make the panel, without its output.
std::vector<std::string> shaping_words_of(const PanelOutcome& panel, const FigureOutcome& figure,
                                          const PictureOptions& options,
                                          const render::PictureRequest& request) {
  const Model& model = *figure.model;
  std::vector<std::string> words = {"morsel", "render", model.file().path.string()};
  const FieldRequest field{std::string(figure.recipe->field), panel.method, {}};
  add_words(words, words_of(field, options.repair));
  add_words(words, render::words_of(request, options.camera, "", model.loaded().source.numbering));
  return words;
}

std::string caption_of(const PanelOutcome& panel, const FigureOutcome& figure) {
  const morse::CriticalPoints& points = panel.run->measurement.critical_points;
  std::string text = std::string(panel.recipe->title) + "\n" + panel.method + "\n";
  if (panel.recipe->region == Region::close_up && figure.region) {
    const bool is_first = panel.run == figure.panels[(*figure.recipe->compared)[1]].run;
    const std::size_t count = is_first ? figure.region->first : figure.region->second;
    return text + grouped(count) + (count == 1 ? " critical point" : " critical points") + " within " +
           core::to_string(figure.region->radius) + " of the middle";
  }
  if (!panel.recipe->points)
    return text + "from " + core::shortest(rounded_out(panel.run->made.field().min())) + " to " +
           core::shortest(rounded_out(panel.run->made.field().max()));
  text += render::counts_line(points.minima, points.saddles, points.maxima);
  if (!panel.recipe->paper.empty()) text += "\nthe paper: " + std::string(panel.recipe->paper);
  return text;
}

/// Counts the points that are kept, moved and new from level to level.
class LinkCounter : public HierarchySink {
 public:
  void begin(const HierarchyBasis&) override {}
  void level(const Level& level) override {
    levels.push_back({level.points.total(), level.cells(SegmentKind::morse_smale).count,
                      level.count(PointStatus::kept), level.count(PointStatus::moved),
                      level.count(PointStatus::fresh)});
  }
  std::vector<LevelLinks> levels;
};

std::vector<LevelLinks> count_links(const FigureRecipe& recipe, const Model& model,
                                    const core::Progress& progress) {
  HierarchyRequest request;
  request.field = {std::string(recipe.field), std::string(recipe.hierarchy_method), {}};
  request.levels = recipe.hierarchy_levels;
  LinkCounter counter;
  run_hierarchy(model.loaded(), prepare(request), {&counter}, progress);
  return std::move(counter.levels);
}

/// The picture as `morsel render` with the panel's command writes it.
std::string panel_png(const render::Image& image, const PanelOutcome& panel, const FigureOutcome& figure,
                      const PictureOptions& options, const render::PictureRequest& request) {
  const Model& model = *figure.model;
  const HashedFile mesh{model.file().path.string(), model.sha256()};
  Provenance provenance(
      command_line(panel.shaping_words),
      tools::request_section(FieldRequest{std::string(figure.recipe->field), panel.method, {}},
                             options.repair),
      {mesh, model.loaded(), panel.run->plan, panel.run->made});
  provenance.set("picture",
                 render::picture_section(request, options.camera, "", model.loaded().source.numbering));
  return drawing::with_png_comment(render::encode_png(image), provenance.json());
}

}  // namespace

FigureOutcome make_figure(const FigureRecipe& recipe, Model& model, const PictureOptions& options,
                          ResultFolder& folder, Provenance provenance, const core::Progress& progress) {
  const std::string name = recipe.file_stem();
  FigureOutcome figure{&recipe, &model, name + ".png", {}, {}, {}, {}};
  SharedScales scales;
  for (std::size_t i = 0; i < recipe.panels.size(); ++i) {
    PanelOutcome panel;
    panel.recipe = &recipe.panels[i];
    panel.method = resolved(recipe.panels[i].method, recipe, model, progress);
    panel.run = &model.run({std::string(recipe.field), panel.method}, progress);
    panel.file = name + letter(i) + ".png";
    scales.add(*panel.recipe, panel.run->made.field());
    figure.panels.push_back(std::move(panel));
  }
  const render::View view = model.studio().view(options.camera.view, options.camera.up, progress);
  if (recipe.compared) {
    const auto points = [&](std::size_t i) -> const morse::CriticalPoints& {
      return figure.panels[(*recipe.compared)[i]].run->measurement.critical_points;
    };
    const ComparedRegion region = fullest_region(model.mesh(), points(0), points(1), points(2),
                                                 model.studio().shown(view, kFacing), kRegion);
    if (region.vertex != core::kNone) figure.region = region;
  }
  if (!recipe.hierarchy_levels.empty()) figure.levels = count_links(recipe, model, progress);

  std::vector<render::Panel> sheet;
  for (PanelOutcome& panel : figure.panels) {
    render::PictureRequest request;
    request.size = options.size;
    request.samples = options.samples;
    request.show = panel.recipe->show;
    request.points = panel.recipe->points;
    request.arcs = panel.recipe->arcs;
    request.legend = panel.recipe->region != Region::close_up;  // the whole picture has it
    request.scale = scales.of(*panel.recipe);
    if (figure.region && panel.recipe->region != Region::none)
      (panel.recipe->region == Region::framed ? request.frame : request.close_up) =
          render::Inset{figure.region->vertex, figure.region->radius};
    panel.shaping_words = shaping_words_of(panel, figure, options, request);
    panel.caption = caption_of(panel, figure);
    const render::Subject subject{panel.run->made.field(), &panel.run->measurement,
                                  render::quantity_of(panel.run->made.input.name, panel.run->made.input.unit,
                                                      panel.run->plan.chain.quantity()),
                                  ""};
    render::Image image = model.studio().take(view, subject, request, progress);
    panel.png = panel_png(image, panel, figure, options, request);
    core::write_file(folder.claim(panel.file), panel.png, core::Sync::never);
    provenance.add_method(panel.run->made.outcome.steps);
    sheet.push_back({std::move(image), panel.caption});
  }
  figure.finding = recipe.finding(figure);
  const std::string title =
      recipe.name() + ". " + std::string(recipe.title) + ": " + model.file().path.filename().string();
  provenance.set_field(figure.panels.front().run->made.input);
  core::write_file(
      folder.claim(figure.file),
      drawing::with_png_comment(render::encode_png(render::make_sheet(sheet, title)), provenance.json()),
      core::Sync::never);
  return figure;
}

}  // namespace morsel::tools::reproduce
