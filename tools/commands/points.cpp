// morsel points: a wanted number of critical points that stand out and lie apart.

#include <limits>
#include <memory>
#include <optional>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/text/numbers.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/points_file.h"
#include "morsel/tools/report/points_writer.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request = {"gaussian-curvature:estimator=diffused", "conventional", {}};
  ChoiceText choice = {.fill = "mean-curvature"};
  std::string output;
};

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
  const PointsPlan plan = prepare(choice_request(options.choice));
  RunFiles files = base.files();
  if (plan.request.fill) files.reads_of_field(*plan.request.fill);
  const bool wants_document = is_document(options.output);
  if (wants_document) {
    files.writes_document("-o", options.output).check();
  } else {
    files.writes("-o", options.output).check();
    check_points_path(options.output);
    check_writable(options.output);
  }
  DocumentTarget document(wants_document ? options.output : "");

  base.read();
  base.make();
  const Stopwatch watch;
  const MadePoints made = make_points(plan, base.loaded(), base.made(), run.console.progress());
  const Timings timings = base.timings({{"points", watch.seconds()}});
  if (made.fill) tell_warnings(*made.fill, run.console);

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
  command.number("--points", options->choice.points.count, "How many, or the reason why there are fewer")
      .between(1, std::numeric_limits<double>::infinity())
      .value("K");
  add_choice_options(command, options->choice);
  add_output_option(command, options->output, ".csv, .json, .ply or .vtp; - is JSON on standard output")
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
