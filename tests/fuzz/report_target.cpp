#include <sstream>
#include <string>

#include "morsel/core/error.h"
#include "morsel/tools/formats/json_reader.h"
#include "morsel/tools/report/difference.h"
#include "morsel/tools/report/document_origin.h"
#include "morsel/tools/report/report_reader.h"
#include "target.h"

namespace {

using namespace morsel;

/// Any document that is taken comes back equal when it is written and read again.
void check_json(std::string_view bytes) {
  try {
    const tools::Json document = tools::read_json(bytes, "fuzz");
    fuzz::require(tools::read_json(document.dump(), "written") == document,
                  "a document written and read again");
    fuzz::require(tools::read_json(document.dump(2), "written") == document, "a document laid out otherwise");
  } catch (const core::BadInput&) {
  }
}

/// Of points that are listed, `rows` are what the document has; the head has none of them.
void check_report(std::string_view bytes) {
  std::istringstream stream{std::string(bytes)};
  const tools::LoadedReport report = tools::read_report(stream, "fuzz");
  fuzz::require(!report.request.methods.empty(), "a report without methods");
  for (const tools::MethodRows& rows : report.document.methods) {
    for (std::size_t i = 0; i < rows.items.size(); ++i) (void)rows.items[i];
    for (std::size_t i = 0; i < rows.diagram.size(); ++i) (void)rows.diagram[i];
  }
  fuzz::require(tools::report_differences(report.document, report.document).empty(),
                "a report does not differ from itself");
}

/// What info shows of any document.
void check_origin(std::string_view bytes) {
  const tools::Json origin = tools::document_origin(bytes, "fuzz");
  if (origin.is_null()) return;
  fuzz::require(origin.at("inputs").is_array(), "a document has inputs, or none");
  fuzz::require(tools::document_origin(tools::read_json(bytes, "fuzz").dump(2), "fuzz") == origin,
                "a document laid out otherwise has the same origin");
}

}  // namespace

void morsel::fuzz::report(std::string_view bytes) {
  check_json(bytes);
  for (const auto check : {check_report, check_origin}) {
    try {
      check(bytes);
    } catch (const core::BadInput&) {
    }
  }
}
