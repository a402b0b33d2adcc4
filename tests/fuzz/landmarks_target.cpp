#include <sstream>
#include <string>

#include "morsel/core/error.h"
#include "morsel/tools/formats/json_reader.h"
#include "morsel/tools/report/landmarks_reader.h"
#include "morsel/tools/report/landmarks_result.h"
#include "target.h"

namespace {

using namespace morsel;

/// A result in a journal, of the default request.
void check_result(std::string_view bytes) {
  static const tools::LandmarksPlan kPlan = tools::prepare(tools::LandmarksRequest());
  const auto read = [](const tools::Json& section) {
    return tools::read_result(tools::JsonView(section, "the result"), kPlan);
  };
  const auto written = [](const tools::LandmarksOnMesh& result) {
    return tools::read_json(tools::json_text(tools::result_section(result, kPlan)), "written");
  };
  const tools::Json once = written(read(tools::read_json(bytes, "fuzz")));
  fuzz::require(written(read(once)) == once, "a result written and read again");
}

void check_written(std::string_view bytes) {
  std::istringstream stream{std::string(bytes)};
  if (const auto report = tools::read_landmarks(stream, "fuzz"))
    fuzz::require(!report->list_path.empty() && !report->request.fields.empty(),
                  "a report without a request");
}

}  // namespace

void morsel::fuzz::landmarks(std::string_view bytes) {
  for (const auto check : {check_result, check_written}) {
    try {
      check(bytes);
    } catch (const core::BadInput&) {
    }
  }
}
