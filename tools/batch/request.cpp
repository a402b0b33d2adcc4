#include "morsel/tools/batch/request.h"

#include "morsel/core/error.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/sha256.h"

namespace morsel::tools::batch {
std::string valid_text(const std::string& text) {
  return Json::parse(json_text(Json(text))).get<std::string>();
}

Json common_key(const BatchRequest& request) {
  const ComparisonRequest& asked = request.comparison;
  std::vector<std::string> specifications = asked.methods;
  specifications.push_back(asked.field);
  const Json key = {{"tool", tool_section()},
                    {"request",
                     {{"field", asked.field},
                      {"methods", asked.methods},
                      {"target", asked.target ? Json(*asked.target) : Json()},
                      {"snap", asked.snap},
                      {"repair", request.repair},
                      {"items", request.items},
                      {"thumbnails", request.thumbnails}}},
                    {"files", input_files(specifications)}};
  return Json::parse(json_text(key));  // as it is read back from a state
}

Json mesh_key(const Json& common, const std::filesystem::path& mesh) {
  Json key = common;
  key["sha256"] = nullptr;
  try {
    key["sha256"] = sha256_of_file(mesh);
  } catch (const core::BadInput&) {  // of which the reader of meshes has more to tell
  }
  return key;
}

std::vector<std::string> compare_words(const BatchRequest& request, const std::filesystem::path& mesh,
                                       const std::filesystem::path& report,
                                       const std::filesystem::path& thumbnails, int threads) {
  const ComparisonRequest& asked = request.comparison;
  std::vector<std::string> words = {"morsel", "compare", "--quiet", "--threads=" + std::to_string(threads),
                                    "--field=" + asked.field};
  for (const std::string& method : asked.methods) words.push_back("--method=" + method);
  if (asked.target) words.push_back("--target=" + std::to_string(*asked.target));
  if (asked.snap) words.emplace_back("--snap");
  if (request.repair) words.emplace_back("--repair");
  if (!request.items) words.emplace_back("--no-items");
  words.push_back("--output=" + report.string());
  if (request.thumbnails) words.push_back("--thumbnails=" + thumbnails.string());
  words.insert(words.end(), {"--", mesh.string()});
  return words;
}

}  // namespace morsel::tools::batch
