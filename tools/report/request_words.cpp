#include "morsel/tools/report/request_words.h"

#include <optional>

#include "morsel/core/io/vertex_mask.h"
#include "morsel/tools/formats/command_line.h"

namespace morsel::tools {
namespace {

void add_target(std::vector<std::string>& words, const std::optional<std::size_t>& target) {
  if (target) add_option(words, "--target", std::to_string(*target));
}

}  // namespace

std::vector<std::string> words_of(const core::BuildOptions& build) {
  std::vector<std::string> words;
  add_flag(words, "--repair", build.repair);
  if (build.weld) words.push_back("--weld=" + core::to_string(*build.weld));
  if (build.mask) add_option(words, "--mask", core::to_string(*build.mask));
  return words;
}

std::vector<std::string> words_of(const ComparisonRequest& request, const core::BuildOptions& build) {
  std::vector<std::string> words;
  add_option(words, "--field", request.field);
  for (const std::string& method : request.methods) add_option(words, "--method", method);
  add_target(words, request.target);
  add_flag(words, "--snap", request.snap);
  if (request.points) add_words(words, words_of(*request.points));
  add_words(words, words_of(build));
  return words;
}

std::vector<std::string> words_of(const FieldRequest& request, const core::BuildOptions& build) {
  std::vector<std::string> words;
  add_option(words, "--field", request.field);
  add_option(words, "--method", request.method);
  add_target(words, request.target);
  add_words(words, words_of(build));
  return words;
}

std::vector<std::string> words_of(const PointsRequest& points) {
  std::vector<std::string> words;
  add_option(words, "--points", std::to_string(points.count));
  add_option(words, "--kind", std::string(to_string(points.kind)));
  add_option(words, "--rank", std::string(to_string(points.rank)));
  add_option(words, "--spacing", core::to_string(points.spacing));
  if (points.fill) add_option(words, "--fill", *points.fill);
  if (points.scale) add_option(words, "--salience-scale", core::to_string(*points.scale));
  add_flag(words, "--percentiles", points.percentiles);
  return words;
}

}  // namespace morsel::tools
