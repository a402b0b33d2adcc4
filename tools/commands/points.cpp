// morsel points: a wanted number of critical points that stand out and lie apart.

#include <limits>
#include <memory>
#include <optional>
#include <string_view>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/text/numbers.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/points_file.h"
#include "morsel/tools/report/points_writer.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {
namespace {

/// As a Morse function that fills up.
constexpr std::string_view kNone = "none";

struct Options {
  std::string mesh;
  FieldRequest request = {"gaussian-curvature:estimator=diffused", "conventional", {}};
  PointsRequest points;
  std::string spacing = core::to_string(PointsRequest().spacing);
  std::string fill = "mean-curvature";
  std::string scale;
  std::string output;
};

PointsRequest points_request(const Options& options) {
  PointsRequest request = options.points;
  request.spacing = core::parse_length(options.spacing, "--spacing");
  if (options.fill != kNone) request.fill = options.fill;
  if (!options.scale.empty()) request.scale = core::parse_length(options.scale, "--salience-scale");
  return request;
}

bool is_document(const std::string& output) {
  return output == "-" || core::file_extension(output) == ".json";
}

std::string described(const MadePoints& made, const PointsRequest& request) {
  const std::size_t count = made.chosen.points.size();
  std::string text = "points: " + core::grouped(count);
  if (count > 1 && made.chosen.spacing > 0)
    text += ", at least " + core::to_digits(made.chosen.spacing) + " (" + core::to_string(request.spacing) +
            ") apart along the surface";
  if (const std::optional<double> mean = made.mean_percentile())
    text += "; mean saliency percentile " + core::to_decimals(*mean, 2);
  return text;
}

int choose(const Options& options, const Run& run) {
  FieldRun base(options.mesh, options.request, run);
  const PointsPlan plan = prepare(points_request(options));
  if (plan.request.fill) base.reads_of_field(*plan.request.fill, "--fill");
  const bool wants_document = is_document(options.output);
  if (wants_document)
    base.writes_document("-o", options.output);
  else
    base.writes("-o", options.output, check_points_path);
  base.check_files();
  DocumentTarget document(wants_document ? options.output : "");

  base.read();
  base.make();
  const Stopwatch watch;
  const MadePoints made = make_points(plan, base.loaded(), base.made(), run.console.progress());
  const Timings timings = base.timings({{"points", watch.seconds()}});

  const Json request = request_section(options.request, plan.request, run.common.repair);
  if (wants_document) {
    write_points_document(document.json(), request, base.source(), made, timings);
    document.commit();
  } else {
    Provenance provenance = base.provenance(request);
    if (made.fill) provenance.set_fill(*made.fill);
    write_points(options.output, made, base.loaded(), base.made().input.name, provenance);
  }
  run.console.message(described(made, plan.request));
  if (!made.note.empty()) run.console.message(made.note);
  if (options.output != "-") run.console.message("points: " + options.output);
  return kDone;
}

}  // namespace

void add_points(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command =
      program.add("points", "Choose critical points of one field that stand out and lie apart");
  add_field_options(command, options->mesh, options->request);
  command
      .number("--points", options->points.count,
              "Number of points; where there are fewer, the reason is printed")
      .between(1, std::numeric_limits<double>::infinity())
      .value("K");
  using morse::PointKind;
  using morse::PointRank;
  command
      .choice("--kind", options->points.kind,
              {PointKind::extrema, PointKind::maxima, PointKind::minima, PointKind::saddles, PointKind::all},
              "extrema, maxima, minima, saddles or all")
      .value("KIND");
  command
      .choice("--rank", options->points.rank, {PointRank::persistence, PointRank::salience},
              "What comes first: persistence or salience")
      .value("RANK")
      .in_detail(
          "persistence: of essential points, which have none, the range of the field on their component; "
          "salience: persistence times the mesh saliency of the surface there, counted by areas and "
          "smoothed, 1 on average");
  command.text("--spacing", options->spacing, "The least distance of two points along the surface")
      .value("LENGTH")
      .in_detail(
          "Points are taken by rank; what is nearer to one that was taken before is passed over. 0: no two "
          "at one vertex. Distances are those of paths along edges and straight across two triangles: not "
          "shorter than geodesic ones, a few percent longer");
  command.text("--fill", options->fill, "A Morse function that fills up, or none")
      .is_function()
      .in_detail(
          "Where the field has too few points, its points come after these, by their own rank and apart from "
          "those");
  command.text("--salience-scale", options->scale, "How far the mesh saliency is smoothed")
      .value("LENGTH")
      .shows_default("the method's sigma, or 8eps");
  add_output_option(command, options->output, ".csv, .json, .ply or .vtp; - is JSON on standard output")
      .shortly("The file to write")
      .in_detail("Points come in the order in which they were chosen, vertices have the input's numbers");
  add_common_options(command, program.common);
  command.examples = {
      {"points bunny.off --points 50 -o points.csv", "50 points that people might mark"},
      {"points scan.off --field mean-curvature --method salient --kind maxima --rank salience "
       "--points 20 --spacing 3% -o bumps.vtp",
       "the 20 bumps that stand out most, for ParaView"}};
  add_specification_notes(command);
  set_action(program, command, options, choose);
}

}  // namespace morsel::tools
