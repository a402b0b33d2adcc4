#include "morsel/tools/report/field_document.h"

#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/mesh_section.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {

Json request_section(const FieldRequest& request, const core::BuildOptions& build) {
  Json section = {{"field", request.field}, {"method", request.method}, {"repair", build.repair}};
  add_build_options(section, build);
  if (request.target) section["target"] = *request.target;
  return section;
}

void begin_field_document(JsonSink& json, std::string_view schema, const Json& request,
                          const FieldSource& source) {
  json.begin_object();
  json.member("schema", schema);
  json.member("tool", tool_section());
  json.member("request", request);
  json.member("mesh", mesh_section(source.mesh.path, source.mesh.sha256, source.loaded));
  json.member("field", field_section(source.made.input));
  json.member("method", method_section(source.plan, source.made, source.loaded.source.numbering));
}

}  // namespace morsel::tools
