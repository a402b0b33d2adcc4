#include "morsel/tools/html/html_sink.h"

#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/html/buffers.h"
#include "morsel/tools/html/page_data.h"
#include "morsel/tools/html/page_sources.h"

namespace morsel::tools {
namespace {

/// JSON inside an element: "<" occurs in its strings only and is escaped, so that no parser of HTML sees a
/// tag.
std::string without_markup(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) c == '<' ? text += "\\u003c" : text += c;
  return text;
}

}  // namespace

struct HtmlSink::State {
  State(core::FileWriter& target, const core::LoadedMesh& input_mesh, const ReportInput& input,
        const ComparisonRequest& request, std::string line, Provenance origin)
      : file(target),
        loaded(input_mesh),
        command(std::move(line)),
        provenance(std::move(origin)),
        json(report_text),
        report(json, loaded, input, request) {}

  core::FileWriter& file;
  const core::LoadedMesh& loaded;
  std::string command;
  Provenance provenance;
  std::string page = joined(html::kPage);
  std::ostringstream report_text;
  JsonStream json;
  ReportWriter report;  // without items
  std::optional<html::PackedStream> packed;
  std::optional<html::Buffers> buffers;
  Json mesh;
  Json methods = Json::array();
};

HtmlSink::HtmlSink(core::FileWriter& file, const core::LoadedMesh& loaded, const ReportInput& input,
                   const ComparisonRequest& request, std::string command, Provenance provenance) {
  ReportInput short_input = input;
  short_input.items = false;
  state_ =
      std::make_unique<State>(file, loaded, short_input, request, std::move(command), std::move(provenance));
}

HtmlSink::~HtmlSink() = default;

void HtmlSink::field(const FieldOutcome& outcome) {
  State& s = *state_;
  s.report.field(outcome);
  s.provenance.set_field(outcome);
  s.file.write(s.page.substr(0, s.page.find(html::kPagePlace)));
  s.file.write("<script type=\"application/octet-stream\" id=\"buffers\">");
  s.packed.emplace(s.file);
  s.buffers.emplace(*s.packed);
  s.mesh = html::write_mesh(s.loaded, *s.buffers);
}

void HtmlSink::method(const MethodOutcome& outcome) {
  state_->report.method(outcome);
  state_->provenance.add_method(outcome.steps);
  state_->methods.push_back(html::write_method(outcome, *state_->buffers));
}

void HtmlSink::finish() {
  State& s = *state_;
  s.report.finish();
  s.packed->finish();
  s.file.write("</script>\n<script type=\"application/octet-stream\" id=\"three\">");
  html::PackedStream three(s.file);
  for (const std::string_view piece : html::kThree) three.write(piece);
  three.finish();
  s.file.write("</script>\n<script type=\"application/json\" id=\"page\">");
  const Json head = {{"schema", "morsel.page/1"},
                     {"command", s.command},
                     {"buffers_bytes", s.packed->size()},
                     {"mesh", s.mesh},
                     {"methods", s.methods}};
  std::string text = json_text(head);
  text.pop_back();  // the closing brace: the report, which is text already, comes in front of it
  s.file.write(without_markup(text + ",\"report\":" + s.report_text.str() + "}"));
  s.file.write("</script>\n");
  s.file.write(s.page.substr(s.page.find(html::kPagePlace) + html::kPagePlace.size()));
  s.file.write(s.provenance.html_comment());
}

}  // namespace morsel::tools
