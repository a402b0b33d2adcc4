#include "morsel/tools/report/document_origin.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "morsel/tools/formats/json_view.h"

namespace morsel::tools {
namespace {

struct KnownSchema {
  std::string_view schema;
  std::string_view what;
};
constexpr auto kKnownSchemas = std::to_array<KnownSchema>({
    {"morsel.batch/1", "the summary of a collection (morsel batch)"},
    {"morsel.comparison/1", "a comparison of methods (morsel compare)"},
    {"morsel.cut/1", "what was cut of a surface (morsel cut)"},
    {"morsel.hierarchy/1", "the levels of a hierarchy (morsel hierarchy)"},
    {"morsel.info/1", "what a mesh is (morsel info)"},
    {"morsel.landmarks/1", "agreement with marked points (morsel landmarks)"},
    {"morsel.points/1", "chosen critical points (morsel points, morsel field)"},
    {"morsel.quads/1", "counts and quality of quads (morsel quads)"},
    {"morsel.reproduction/1", "the paper's figures and table (morsel reproduce)"},
    {"morsel.segments/1", "a table of segments (morsel segment)"},
    {"morsel.stability/1", "the repeatability of critical points (morsel stability)"},
    {"morsel.sweep/1", "a parameter sweep (morsel sweep)"},
});

const std::string* text_at(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : found->get_ptr<const std::string*>();
}

/// Collects the files with hashes of all objects and keeps the elements of no list but those of the request
/// and of the field.
class OriginFollower : public JsonFollower {
 public:
  void key(std::size_t depth, std::string_view name) override {
    if (depth != 1) return;
    is_in_request_ = name == "request";
    is_kept_ = is_in_request_ || name == "field";
  }
  bool end(std::size_t depth, const Json& value) override {
    if (value.is_object() && !is_in_request_) add_files(value);
    return is_kept_ || depth < 2;
  }
  Json take() { return std::move(inputs_); }

 private:
  void add_files(const Json& object) {
    if (const std::string* hash = text_at(object, "sha256")) {
      const std::string* path = text_at(object, "path");
      const auto mesh = object.find("mesh");  // of a collection
      if (path == nullptr && mesh != object.end() && mesh->is_object()) path = text_at(*mesh, "path");
      if (path != nullptr) add(*path, *hash);
    }
    constexpr std::string_view kSuffix = "_sha256";  // of a key that names a file
    for (const auto& [key, value] : object.items()) {
      if (!key.ends_with(kSuffix) || !value.is_string()) continue;
      if (const std::string* path = text_at(object, key.substr(0, key.size() - kSuffix.size())))
        add(*path, value.get_ref<const std::string&>());
    }
  }
  void add(const std::string& path, const std::string& hash) {
    if (seen_.emplace(path, hash).second) inputs_.push_back({{"path", path}, {"sha256", hash}});
  }

  bool is_in_request_ = false;
  bool is_kept_ = false;
  Json inputs_ = Json::array();
  std::set<std::pair<std::string, std::string>> seen_;
};

}  // namespace

std::string described_schema(std::string_view schema) {
  const auto* found = std::ranges::find(kKnownSchemas, schema, &KnownSchema::schema);
  return std::string(found == kKnownSchemas.end() ? "a document of morsel" : found->what);
}

Json document_origin(std::string_view text, const std::string& name) {
  OriginFollower follower;
  const Json document = read_json(text, name, {}, &follower);
  if (!document.is_object()) return {};
  const std::string* schema = text_at(document, "schema");
  if (schema == nullptr || !schema->starts_with("morsel.") || !document.contains("tool")) return {};
  const JsonView view(document, name + " is damaged");
  Json origin = {
      {"schema", *schema},
      {"tool", {{"name", view["tool"]["name"].text()}, {"version", view["tool"]["version"].text()}}},
      {"inputs", follower.take()}};
  if (const auto request = view.find("request")) {
    static_cast<void>(request->members());
    origin["request"] = request->json();
  }
  if (const auto field = view.find("field")) {
    static_cast<void>((*field)["parameters"].members());
    origin["field"] = {{"name", (*field)["name"].text()}, {"parameters", (*field)["parameters"].json()}};
  }
  return origin;
}

}  // namespace morsel::tools
