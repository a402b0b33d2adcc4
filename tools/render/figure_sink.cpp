#include "morsel/tools/render/figure_sink.h"

#include <utility>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/formats/png_comment.h"
#include "morsel/tools/render/caption.h"

namespace morsel::tools::render {
namespace {

constexpr std::size_t kPointsWithArcs = 500;  // beyond, arcs hide the surface
constexpr std::size_t kFullPanels = 12;       // beyond, a sheet's are halved

}  // namespace

FigureSink::FigureSink(ResultFolder& folder, const core::LoadedMesh& loaded, CameraText camera, Size size,
                       Provenance provenance, core::Progress progress)
    : folder_(folder),
      loaded_(loaded),
      camera_(std::move(camera)),
      provenance_(std::move(provenance)),
      all_(provenance_),
      progress_(std::move(progress)) {
  camera_.check();
  request_.size = size;
  check_size(size);
  if (!camera_.inset.empty()) request_.inset = find_inset(parse_inset(camera_.inset), loaded_);
}

void FigureSink::field(const FieldOutcome& outcome) {
  field_name_ = outcome.name;
  unit_ = outcome.unit;
  provenance_.set_field(outcome);
  all_ = provenance_;
  studio_.emplace(outcome.field.mesh());
  view_ = studio_->view(camera_.view, camera_.up, progress_);
}

void FigureSink::method(const MethodOutcome& outcome) {
  const std::string name = names_.next(outcome.name);
  const morse::CriticalPoints& points = outcome.shown_points();
  request_.arcs = !outcome.chosen && points.total() <= kPointsWithArcs;
  Image picture = studio_->take(view_, subject_of(outcome, field_name_, unit_), request_, progress_);
  std::string caption =
      outcome.specification + "\n" + counts_line(points.minima, points.saddles, points.maxima);
  Provenance provenance = provenance_.with_method(outcome.steps);
  provenance.set("picture", picture_section(request_, camera_, caption, loaded_.source.numbering));
  write(name, with_caption(picture, caption), provenance);
  all_.add_method(outcome.steps);
  panels_.push_back({std::move(picture), std::move(caption)});
}

void FigureSink::finish() {
  if (panels_.size() > kFullPanels)
    for (Panel& panel : panels_) panel.image = halved(panel.image);
  Json picture = picture_section(request_, camera_, "", loaded_.source.numbering);
  picture.erase("arcs");  // each panel has its own
  picture.erase("caption");
  all_.set("picture", std::move(picture));
  write("sheet", make_sheet(panels_), all_);
}

void FigureSink::write(const std::string& name, const Image& image, const Provenance& provenance) const {
  core::write_file(folder_.claim(name + ".png"),
                   drawing::with_png_comment(encode_png(image), provenance.json()), core::Sync::never);
}

}  // namespace morsel::tools::render
