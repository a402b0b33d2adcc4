/// Geodesic distance as a Morse function that is chosen by name.

#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/functions/geodesic.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::TriangleMesh;

/// A source in the text form: a vertex of the input, or the end of an axis.
struct Source {
  std::int64_t vertex = -1;  // −1 for an end
  int axis = 0;
  bool highest = false;
};

Source parse_source(const std::string& text, const std::string& what) {
  if (text.size() == 5 && (text.starts_with("min-") || text.starts_with("max-")) && text[4] >= 'x' &&
      text[4] <= 'z')
    return {-1, text[4] - 'x', text.starts_with("max")};
  const std::int64_t vertex = core::parse_integer(
      text, what + " (numbers of vertices separated by /, or min-x, max-x, min-y, max-y, min-z, max-z)");
  if (vertex < 0) throw core::InvalidArgument(what + " must not be negative, unlike " + text);
  return {vertex, 0, false};
}

/// The lowest or highest vertex, the smallest in a tie.
Index end_of(const TriangleMesh& mesh, int axis, bool highest) {
  Index best = 0;
  for (Index v = 1; v < mesh.vertex_count(); ++v) {
    const double x = mesh.position(v)[axis];
    const double y = mesh.position(best)[axis];
    if (highest ? x > y : x < y) best = v;
  }
  return best;
}

Index resolve(const Source& source, const TriangleMesh& mesh, const core::MeshSource* file) {
  if (source.vertex < 0) return end_of(mesh, source.axis, source.highest);
  const bool same =
      file == nullptr || (file->numbering.from_input.empty() && file->numbering.to_input.empty());
  const std::size_t count = same ? mesh.vertex_count() : file->numbering.input_count;
  const auto vertex = static_cast<std::size_t>(source.vertex);
  if (vertex >= count)
    throw core::BadInput("geodesic: there is no vertex " + std::to_string(vertex) +
                         " to be a source: the mesh has " + std::to_string(count) + " vertices, 0 to " +
                         std::to_string(count - 1));
  const Index v = same ? static_cast<Index>(vertex) : file->numbering.mesh_vertex(static_cast<Index>(vertex));
  if (v == core::kNone)
    throw core::BadInput("geodesic: vertex " + std::to_string(vertex) +
                         " cannot be a source: no face uses it, so it was dropped");
  return v;
}

class Geodesic final : public core::MorseFunction {
 public:
  Geodesic(std::vector<Source> sources, std::size_t samples, const GeodesicOptions& options)
      : sources_(std::move(sources)), samples_(samples), options_(options) {}

  core::FunctionResult evaluate(const TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    core::Parameters common = {
        {"time", options_.time}, {"boundary", boundary()}, {"delaunay", options_.delaunay}};
    if (sources_.empty()) {
      AverageGeodesicResult result = average_geodesic_distance(mesh, samples_, options_, context.progress);
      core::Parameters parameters = {{"mode", "average"},
                                     {"samples", static_cast<std::int64_t>(result.samples.size())}};
      parameters.insert(parameters.end(), common.begin(), common.end());
      parameters.emplace_back("time_step", result.time);
      return {std::move(result.field), std::move(parameters)};
    }
    std::vector<Index> vertices;
    std::string numbers;
    for (const Source& source : sources_) {
      vertices.push_back(resolve(source, mesh, context.source));
      const Index shown = context.source == nullptr ? vertices.back()
                                                    : context.source->numbering.input_vertex(vertices.back());
      numbers += (numbers.empty() ? "" : "/") + std::to_string(shown);
    }
    GeodesicResult result = geodesic_distance(mesh, vertices, options_, context.progress);
    core::Parameters parameters = {{"mode", "distance"}, {"source", numbers}};
    parameters.insert(parameters.end(), common.begin(), common.end());
    parameters.emplace_back("time_step", result.time);
    return {std::move(result.field), std::move(parameters)};
  }

 private:
  std::string boundary() const {
    return options_.boundary == HeatBoundary::average   ? "average"
           : options_.boundary == HeatBoundary::neumann ? "neumann"
                                                        : "dirichlet";
  }

  std::vector<Source> sources_;  // none: the average
  std::size_t samples_;
  GeodesicOptions options_;
};

}  // namespace

std::unique_ptr<core::MorseFunction> make_geodesic(core::ParameterReader& reader) {
  const bool average = reader.choice("mode", "distance", {"distance", "average"},
                                     "to the nearest source, or averaged over the surface") == "average";
  const std::vector<std::string> names =
      reader.list("source", average ? "" : nullptr,
                  "vertices of the mesh's file separated by /, or min-x, max-x … max-z");
  const auto samples = static_cast<std::size_t>(
      reader.count("samples", 50, 1, 100000, "points that mode=average measures from"));
  GeodesicOptions options;
  options.time = reader.number("time", 1, core::kPositive,
                               "how long heat flows, in squared mean edge lengths: small is sharp");
  const std::string boundary =
      reader.choice("boundary", "average", {"average", "neumann", "dirichlet"},
                    "the boundary condition of heat; average hardly depends on the boundary");
  if (boundary != "average")
    options.boundary = boundary == "neumann" ? HeatBoundary::neumann : HeatBoundary::dirichlet;
  options.delaunay = reader.flag(
      "delaunay", true, "whether edges are flipped along the surface first, for meshes with thin triangles");
  if (average && reader.given("source"))
    throw core::InvalidArgument(reader.owner() + " takes source or mode=average, not both");
  if (!average && reader.given("samples"))
    throw core::InvalidArgument(reader.owner() + " takes samples with mode=average only");
  std::vector<Source> sources;
  if (reader.given("source"))
    for (const std::string& name : names) sources.push_back(parse_source(name, reader.owner() + ":source"));
  return std::make_unique<Geodesic>(std::move(sources), samples, options);
}

}  // namespace morsel::morse
