#include "morsel/tools/html/page_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/html/arc_paths.h"
#include "morsel/tools/html/arc_reach.h"

namespace morsel::tools::html {
namespace {

using core::Index;
using core::kNone;

constexpr double kSteps = 65535;  // 16 bits

/// The value below which this share of the values lies.
double percentile(std::vector<double>& values, double share) {
  const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Values beyond these percentiles have the colours of the scale's ends, so that the steps resolve the
/// others.
constexpr double kLowest = 0.005;
constexpr double kHighest = 0.995;

Json write_values(const core::ScalarField& field, Buffers& buffers) {
  std::vector<double> sorted(field.values().begin(), field.values().end());
  const double low = percentile(sorted, kLowest);
  const double high = percentile(sorted, kHighest);
  // halves, so that the difference of huge values is finite
  const double half_range = high / 2 - low / 2;
  std::vector<std::uint16_t> data(field.values().size(), 0);
  if (half_range > 0)
    core::parallel_for_each(data.size(), [&](std::size_t v) {
      const double share = (field.values()[v] / 2 - low / 2) / half_range;
      data[v] = static_cast<std::uint16_t>(std::lround(kSteps * std::clamp(share, 0., 1.)));
    });
  return {{"low", low}, {"high", high}, {"data", buffers.add(data)}};
}

/// The number among the critical points of one at vertex v, which is one.
std::uint32_t number_of(const std::vector<morse::CriticalPoint>& points, Index v) {
  const auto at =
      std::lower_bound(points.begin(), points.end(), v,
                       [](const morse::CriticalPoint& p, Index vertex) { return p.vertex < vertex; });
  return static_cast<std::uint32_t>(at - points.begin());
}

Json write_points(const MethodOutcome& outcome, Buffers& buffers) {
  const std::vector<morse::CriticalPoint>& points = outcome.measurement.critical_points.points;
  std::vector<std::uint32_t> vertex, multiplicity, origin, match(points.size(), 0);
  std::vector<std::uint8_t> type;
  std::vector<double> value;
  for (std::size_t i = 0; i < points.size(); ++i) {
    vertex.push_back(points[i].vertex);
    type.push_back(static_cast<std::uint8_t>(points[i].type));
    multiplicity.push_back(points[i].multiplicity);
    value.push_back(outcome.field.value(points[i].vertex));
    origin.push_back(outcome.origins[i] + 1);  // kNone becomes 0
  }
  static_assert(kNone + 1 == 0);
  for (const auto* matches : {&outcome.compared_to_first.kept, &outcome.compared_to_first.moved})
    for (const Match& m : *matches) match[m.other] = static_cast<std::uint32_t>(m.reference + 1);
  return {{"vertex", buffers.add_deltas(vertex)},
          {"place", buffers.add_deltas(outcome.places)},
          {"type", buffers.add(type)},
          {"multiplicity", buffers.add_deltas(multiplicity)},
          {"value", buffers.add(value)},
          {"origin", buffers.add_deltas(origin)},
          {"match", buffers.add_deltas(match)}};
}

Json write_pairs(const MethodOutcome& outcome, Buffers& buffers) {
  const std::vector<morse::CriticalPoint>& points = outcome.measurement.critical_points.points;
  std::vector<std::uint32_t> extremum, saddle;
  for (const persistence::PersistencePair& pair : outcome.measurement.diagram.pairs) {
    extremum.push_back(pair.kind == persistence::PairKind::saddle_cap
                           ? static_cast<std::uint32_t>(points.size()) + pair.extremum
                           : number_of(points, pair.extremum));
    saddle.push_back(number_of(points, pair.saddle));
  }
  return {{"extremum", buffers.add_deltas(extremum)}, {"saddle", buffers.add_deltas(saddle)}};
}

Json write_paths(ArcPaths paths, const std::vector<morse::CriticalPoint>& points, Buffers& buffers) {
  for (std::uint32_t& saddle : paths.saddle) saddle = number_of(points, saddle);
  return {{"saddle", buffers.add_deltas(paths.saddle)},
          {"reach", buffers.add(paths.reach)},
          {"length", buffers.add_deltas(paths.length)},
          {"end", buffers.add(paths.end)},
          {"cells", buffers.add_deltas(paths.cells)}};
}

}  // namespace

Json write_mesh(const core::LoadedMesh& loaded, Buffers& buffers) {
  const core::TriangleMesh& mesh = loaded.mesh;
  const core::BoundingBox& box = mesh.bounding_box();
  const double step = (box.max - box.min).maxCoeff() / kSteps;
  const std::size_t vertices = mesh.vertex_count();
  std::vector<std::uint32_t> positions(3 * vertices, 0);
  if (step > 0)
    core::parallel_for_each(vertices, [&](std::size_t v) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto axis = static_cast<Eigen::Index>(c);
        positions[c * vertices + v] = static_cast<std::uint32_t>(
            std::lround((mesh.position(static_cast<Index>(v))[axis] - box.min[axis]) / step));
      }
    });
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh.triangles().size());
  for (const core::Triangle& triangle : mesh.triangles())
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  const std::vector<Index>& input = loaded.source.numbering.to_input;
  return {{"vertices", vertices},
          {"triangles", mesh.triangle_count()},
          {"origin", {box.min[0], box.min[1], box.min[2]}},
          {"step", step},
          {"positions", buffers.add_deltas(positions)},
          {"corners", buffers.add_deltas(corners)},
          {"input_vertices", input.empty() ? Json() : buffers.add_deltas(input)}};
}

Json write_method(const MethodOutcome& outcome, Buffers& buffers) {
  const Measurement& m = outcome.measurement;
  const mscomplex::PersistenceHierarchy hierarchy(outcome.field, m.complex);
  const auto reach = [&](mscomplex::ArcKind kind) { return arc_reach(hierarchy, kind); };
  const std::vector<morse::CriticalPoint>& points = m.critical_points.points;
  Json section = {{"name", outcome.specification}};
  section["values"] = write_values(outcome.field, buffers);
  section["points"] = write_points(outcome, buffers);
  section["pairs"] = write_pairs(outcome, buffers);
  section["segments"] = {{"ascending", buffers.add_deltas(m.segmentation.ascending.triangle)},
                         {"descending", buffers.add_deltas(m.segmentation.descending.triangle)}};
  section["arcs"] = {
      {"descending",
       write_paths(descending_paths(m.complex, reach(mscomplex::ArcKind::descending)), points, buffers)},
      {"ascending",
       write_paths(ascending_paths(m.complex, reach(mscomplex::ArcKind::ascending)), points, buffers)}};
  return section;
}

}  // namespace morsel::tools::html
