// morsel info: what a mesh is, or what is wrong with it; and where a file that the program wrote comes from.

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "morsel/core/error.h"
#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/file_kind.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/parameters.h"
#include "morsel/core/text/printable.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/document_origin.h"
#include "morsel/tools/report/mesh_section.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string file;
  bool json = false;
};

/// The file as it is: a mesh, or polygons with defects.
struct Findings {
  core::LoadedSoup file;
  std::optional<core::LoadedMesh> loaded;
  std::vector<core::Defect> defects;
  /// What is still wrong with the mesh when it is repaired; empty if that makes a mesh.
  std::vector<core::Defect> lasting;

  /// What repair does about a defect, or did; empty if it remains.
  std::string_view repair_of(const core::Defect& defect) const {
    const bool remains = std::ranges::find(lasting, defect.kind, &core::Defect::kind) != lasting.end();
    return remains ? "" : core::repair_of(defect.kind);
  }
  const std::vector<std::string>& warnings() const {
    return loaded ? loaded->source.warnings : file.warnings;
  }
};

/// The defects that refuse the mesh; none if it is one, which `loaded` then is.
std::vector<core::Defect> try_to_make(const core::LoadedSoup& file, const core::BuildOptions& options,
                                      const std::string& path, const core::Progress& progress,
                                      std::optional<core::LoadedMesh>& loaded) {
  try {
    loaded = core::make_mesh(file, path, options, progress);
    return {};
  } catch (const core::MeshError& error) {
    return error.defects();
  }
}

Findings inspect(const MeshOrigin& mesh, const core::BuildOptions& options, const core::Progress& progress) {
  const std::string path = mesh.path.string();
  Findings findings{read_polygon_soup(mesh, progress), std::nullopt, {}, {}};
  findings.defects = try_to_make(findings.file, options, path, progress, findings.loaded);
  if (findings.defects.empty()) return findings;
  // What repair does is known when it is done.
  std::optional<core::LoadedMesh> repaired;
  core::BuildOptions with_repair = options;
  with_repair.repair = true;
  findings.lasting =
      options.repair ? findings.defects : try_to_make(findings.file, with_repair, path, progress, repaired);
  // With faces that name missing vertices nothing was repaired.
  std::erase_if(findings.lasting,
                [](const core::Defect& defect) { return !core::repair_of(defect.kind).empty(); });
  return findings;
}

Json properties_section(const Findings& findings) {
  Json names = Json::array();
  const std::vector<core::VertexProperty>& properties =
      findings.loaded ? findings.loaded->source.properties : findings.file.properties;
  for (const core::VertexProperty& property : properties) names.push_back(property.name);
  return names;
}

Json head_section() { return {{"schema", "morsel.info/1"}, {"tool", tool_section()}}; }

Json as_json(const std::string& path, const MeshOrigin& file, const core::BuildOptions& options,
             const Findings& findings) {
  Json document = head_section();
  document["valid"] = findings.loaded.has_value();
  if (findings.loaded) {
    const core::TriangleMesh& mesh = findings.loaded->mesh;
    document["mesh"] = mesh_section(path, sha256_of(file, options), *findings.loaded);
    document["mesh"]["bbox_min"] = {mesh.bounding_box().min.x(), mesh.bounding_box().min.y(),
                                    mesh.bounding_box().min.z()};
    document["mesh"]["bbox_max"] = {mesh.bounding_box().max.x(), mesh.bounding_box().max.y(),
                                    mesh.bounding_box().max.z()};
    Json components = Json::array();
    for (core::Index c = 0; c < mesh.component_count(); ++c)
      components.push_back({{"euler_characteristic", mesh.euler_characteristic(c)},
                            {"genus", mesh.genus(c)},
                            {"boundary_loops", mesh.boundary_loop_count(c)}});
    document["components"] = std::move(components);
  } else {
    document["mesh"] = {{"path", path},
                        {"sha256", sha256_of(file, options)},
                        {"vertices", findings.file.soup.positions.size()},
                        {"polygons", findings.file.soup.polygon_count()}};
    if (!findings.warnings().empty()) document["mesh"]["warnings"] = findings.warnings();
  }
  document["vertex_properties"] = properties_section(findings);
  Json defects = Json::array();
  for (const core::Defect& defect : findings.defects)
    defects.push_back({{"kind", core::defect_name(defect.kind)},
                       {"count", defect.count},
                       {"first", defect.first},
                       {"repair", findings.repair_of(defect)}});
  document["defects"] = std::move(defects);
  if (!findings.defects.empty()) document["repairable"] = findings.lasting.empty();
  return document;
}

void line(std::string_view name, const std::string& value) {
  std::string label(name);
  label.resize(24, ' ');
  std::cout << "  " << label << core::printable(value) << '\n';
}

void print_text(const Findings& findings, bool repair_tried) {
  if (findings.loaded) {
    const core::TriangleMesh& mesh = findings.loaded->mesh;
    line("vertices", grouped(mesh.vertex_count()));
    line("edges", grouped(mesh.edge_count()));
    line("faces", grouped(mesh.triangle_count()));
    line("components", grouped(mesh.component_count()));
    line("boundary loops", grouped(mesh.boundary_loop_count()));
    line("Euler characteristic", std::to_string(mesh.euler_characteristic()));
    line("genus", grouped(mesh.genus()));
    const core::BoundingBox& box = mesh.bounding_box();
    const auto point = [](const core::Point& p) {
      return "(" + core::shortest(p.x()) + ", " + core::shortest(p.y()) + ", " + core::shortest(p.z()) + ")";
    };
    line("bounding box", point(box.min) + " to " + point(box.max));
    line("its diagonal", core::shortest(box.diagonal()));
    line("eps (0.3 % of it)", core::shortest(mesh.epsilon()));
    for (const core::Repair& repair : findings.loaded->source.repairs)
      line("repair", repair.action + ": " + grouped(repair.count));
  } else {
    line("vertices", grouped(findings.file.soup.positions.size()));
    line("polygons", grouped(findings.file.soup.polygon_count()));
  }
  for (const Json& name : properties_section(findings)) line("vertex property", name.get<std::string>());
  for (const std::string& warning : findings.warnings()) line("warning", warning);
  if (findings.defects.empty()) line("defects", "none");
  for (const core::Defect& defect : findings.defects) {
    const std::string repair(findings.repair_of(defect));
    line("defect", core::describe(defect) + (repair.empty() ? "; no repair fixes this"
                                             : repair_tried ? "; not repaired because of the others"
                                             : findings.lasting.empty()
                                                 ? "; --repair fixes this by " + repair
                                                 : "; alone, --repair would fix this by " + repair));
  }
  if (repair_tried || findings.lasting.empty()) return;
  std::vector<std::string> lasting;
  for (const core::Defect& defect : findings.lasting) lasting.push_back(core::describe(defect));
  line("after --repair", "no mesh: it still has " + core::listed(lasting, " and "));
}

/// The usual members; the rest in --json. `is_document`: whether it is document_origin()'s.
void print_provenance(const Json& provenance, bool is_document) {
  const auto text = [](const Json& object, const char* key) {
    return object.at(key).get_ref<const std::string&>();
  };
  const auto with_parameters = [&](const char* label, const Json& made) {
    line(label, text(made, "name") + " " + json_text(made.at("parameters")));
  };
  if (is_document) {
    const std::string& schema = text(provenance, "schema");
    line("document", described_schema(schema) + ", " + schema);
  }
  line("made by", "morsel " + text(provenance.at("tool"), "version"));
  if (!is_document) line("command", text(provenance, "command"));
  if (is_document && provenance.contains("request")) line("request", json_text(provenance["request"]));
  for (const Json& input : provenance.at("inputs"))
    line("input", text(input, "path") + ", sha256 " + text(input, "sha256"));
  if (provenance.contains("field")) with_parameters("field", provenance["field"]);
  if (provenance.contains("methods"))
    for (const Json& method : provenance["methods"]) with_parameters("method", method);
}

/// A mesh is described though what it holds of its provenance is damaged.
Json provenance_of(const std::string& path, const MeshOrigin& file, bool is_mesh, Console& console) {
  try {
    return file.bytes ? find_provenance(core::DecodedBytes(*file.bytes, path).view()) : read_provenance(path);
  } catch (const core::BadInput& error) {
    if (!is_mesh) throw core::BadInput(path + ": " + error.what());
    console.warning(path + ": " + error.what());
    return {};
  }
}

/// document_origin() of a file that is JSON; null of others.
Json origin_of_document(const std::string& path) {
  const core::FileBytes bytes(path, path);
  const core::DecodedBytes decoded(bytes.view(), path);
  return core::file_kind(decoded.view()) == "JSON" ? document_origin(decoded.view(), path) : Json();
}

/// "; it is xz data" of a file that is recognised.
std::string remark_on_kind(const std::string& path) {
  const std::string_view kind = core::file_kind(core::FileBytes(path, path).view());
  return kind.empty() ? "" : "; it is " + std::string(kind);
}

int inform(const Options& options, const Run& run) {
  std::optional<Findings> findings;
  const MeshOrigin file = mesh_file(options.file, run);
  if (file.format || core::has_mesh_extension(options.file) || core::recognised_format(options.file))
    findings = inspect(file, run.common.build, run.console.progress());
  if (findings && options.json)  // which may go to another program
    for (const std::string& warning : findings->warnings()) run.console.warning(warning);
  Json provenance = provenance_of(options.file, file, findings.has_value(), run.console);
  const bool is_document = !findings && provenance.is_null();
  if (is_document) provenance = origin_of_document(options.file);
  // The points and lines that morsel writes for ParaView are no mesh.
  if (findings && !provenance.is_null() && findings->file.soup.polygon_count() == 0) findings.reset();
  if (!findings && provenance.is_null())
    throw core::BadInput("\"" + options.file + "\" is no mesh (" + core::mesh_extensions() +
                         ") and has no provenance" + remark_on_kind(options.file));
  if (options.json) {
    Json document = findings ? as_json(options.file, file, run.common.build, *findings) : head_section();
    if (!provenance.is_null()) document["provenance"] = provenance;
    std::cout << json_text(document, 2) << '\n';
    return kDone;
  }
  std::cout << core::printable(options.file) << '\n';
  if (findings) print_text(*findings, run.common.build.repair);
  if (!provenance.is_null()) print_provenance(provenance, is_document);
  return kDone;
}

}  // namespace

void add_info(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "info",
      "What a mesh is: counts, topology, components, defects; and where a file that morsel wrote comes from");
  command
      .path("FILE", options->file,
            "A triangle mesh (" + core::mesh_extensions() + "), or what morsel wrote; - is standard input")
      .required()
      .in_detail(
          "What morsel wrote may be a mesh, .png, .svg, .vtp, .html, .csv, .txt or a JSON document, of which "
          "the request is shown in place of the command");
  command.flag("--json", options->json, "As JSON instead of text");
  add_common_options(command, program.common);
  command.examples = {{"info scan.off", "counts, genus, boundary loops, and what would have to be repaired"},
                      {"info figure.png", "the command, the mesh and the version that made a picture"}};
  set_action(program, command, options, inform);
}

}  // namespace morsel::tools
