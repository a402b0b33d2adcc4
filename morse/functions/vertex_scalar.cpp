#include "morsel/morse/functions/vertex_scalar.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/value_file.h"
#include "morsel/core/mesh/welding.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::morse {
namespace {

using core::BadInput;
using core::Index;
using core::shown;

std::size_t input_vertex_count(const core::TriangleMesh& mesh, const core::VertexNumbering& numbering) {
  const bool same = numbering.to_input.empty() && numbering.from_input.empty();
  return same ? mesh.vertex_count() : numbering.input_count;
}

/// `place(i)` names the place of value i; `remark` is for the error where the number of values is wrong.
template <class Place>
core::ScalarField make_field(const core::TriangleMesh& mesh, const core::VertexNumbering& numbering,
                             std::span<const double> values, const std::string& origin, const Place& place,
                             const std::string& remark = {}) {
  const std::size_t expected = input_vertex_count(mesh, numbering);
  if (values.size() != expected)
    throw BadInput(origin + " has " + std::to_string(values.size()) + " values, but the mesh's file has " +
                   std::to_string(expected) + " vertices" + remark);
  std::vector<double> chosen(mesh.vertex_count());
  std::size_t bad = 0;
  Index first = core::kNone;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index i = numbering.input_vertex(v);
    chosen[v] = values[i];
    if (std::isfinite(chosen[v])) continue;
    ++bad;
    first = std::min(first, i);
  }
  if (bad > 0)
    throw BadInput(origin + ", " + place(first) + ": vertex " + std::to_string(first) + " has the value " +
                   core::shortest(values[first]) +
                   (bad > 1 ? ", the first of " + std::to_string(bad) + " that are not finite"
                            : ", which is not finite") +
                   (std::isnan(values[first]) ? "; a mask (--mask) leaves vertices out" : ""));
  return {mesh, std::move(chosen)};
}

const core::VertexProperty& find_property(const core::MeshSource* source, const std::string& name) {
  std::string available;
  if (source != nullptr)
    for (const core::VertexProperty& property : source->properties) {
      if (property.name == name) return property;
      available += (available.empty() ? "" : ", ") + property.name;
    }
  throw BadInput("the mesh's file has no scalar property " + shown(name) + " for its vertices; it has " +
                 (available.empty() ? "none (PLY, VTK and GIFTI files may have them)" : available));
}

class VertexScalar final : public core::MorseFunction {
 public:
  explicit VertexScalar(VertexScalarOptions options) : options_(std::move(options)) {}

  core::FunctionResult evaluate(const core::TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    core::Parameters parameters;
    if (options_.file.empty())
      parameters.emplace_back("property", options_.property);
    else
      parameters.emplace_back("file", options_.file.string());
    if (!options_.column.empty()) parameters.emplace_back("column", options_.column);
    std::vector<std::string> warnings;
    core::ScalarField field = vertex_scalar(mesh, context.source, options_, context.progress, &warnings);
    return {std::move(field), std::move(parameters), std::move(warnings)};
  }
  core::FunctionTraits traits() const override { return {.needs_input_vertices = true}; }
  const core::VertexValues* given_values() const override { return &options_; }

 private:
  VertexScalarOptions options_;
};

}  // namespace

core::ScalarField vertex_scalar(const core::TriangleMesh& mesh, const core::MeshSource* source,
                                const VertexScalarOptions& options, const core::Progress& progress,
                                std::vector<std::string>* warnings) {
  if (options.file.empty() == options.property.empty())
    throw core::InvalidArgument("a vertex scalar comes from a file or from a property: name one of them");
  if (options.file.empty() && !options.column.empty())
    throw core::InvalidArgument("a vertex scalar has a column only if it comes from a file");
  static const core::VertexNumbering kSame;
  const core::VertexNumbering& numbering = source == nullptr ? kSame : source->numbering;
  if (options.file.empty()) {
    const core::VertexProperty& property = find_property(source, options.property);
    return make_field(mesh, numbering, property.values, "the property " + shown(property.name),
                      [](std::size_t i) { return "entry " + std::to_string(i); });
  }
  core::ValueFile file = core::read_value_file(options.file, options.column, progress);
  std::string remark;
  for (const std::string& warning : file.warnings) remark += "; " + warning;
  core::ScalarField field =
      make_field(mesh, numbering, file.values, options.file.string(), file.place, remark);
  if (const core::JoinedDifference d = core::compare_joined(numbering, file.values); d.count > 0)
    file.warnings.push_back("joined vertices have different values in " + options.file.string() + " at " +
                            core::grouped(d.count) + " (by up to " + core::shortest(d.largest) +
                            "); that of the first vertex is taken");
  if (warnings != nullptr) *warnings = std::move(file.warnings);
  return field;
}

std::unique_ptr<core::MorseFunction> make_vertex_scalar(core::ParameterReader& reader) {
  const bool by_property = reader.given("property");
  VertexScalarOptions options;
  options.file = reader.file("file", by_property ? "" : nullptr,
                             "a file with a value for each vertex of the mesh's file (text, CSV, .npy, "
                             "FreeSurfer, GIFTI, VTK, PLY), or else a property");
  options.property = reader.text("property", "", "a scalar property of the vertices in the mesh's own file");
  options.column = reader.text("column", "", "which column or array of the file, by name or from 1");
  const bool by_file = reader.given("file");
  if (by_property && by_file)
    throw core::InvalidArgument(reader.owner() + " takes file or property, not both");
  if ((by_property && options.property.empty()) || (by_file && options.file.empty()))
    throw core::InvalidArgument(reader.owner() + ":" + (by_file ? "file" : "property") +
                                " must not be empty");
  if (by_property && !options.column.empty())
    throw core::InvalidArgument(reader.owner() + " takes column with file, not with property");
  return std::make_unique<VertexScalar>(std::move(options));
}

}  // namespace morsel::morse
