#include "morsel/mscomplex/arrays.h"

#include <algorithm>

#include "morsel/core/parallel/parallel.h"

namespace morsel::mscomplex {
namespace {

using core::Index;

template <class T, class Get>
core::FlatArray<T> array_of(Index count, const Get& get) {
  core::FlatArray<T> result(count);
  core::parallel_for_each(count, [&](std::size_t i) { result[i] = get(static_cast<Index>(i)); });
  return result;
}

constexpr std::size_t kArcsTogether = 64;

}  // namespace

core::FlatArray<Node> nodes_of(const MorseSmaleComplex& complex) {
  return array_of<Node>(complex.node_count(), [&](Index i) { return complex.node(i); });
}

core::FlatArray<Arc> arcs_of(const MorseSmaleComplex& complex) {
  return array_of<Arc>(complex.arc_count(), [&](Index i) { return complex.arc(i); });
}

core::FlatArray<Quad> quads_of(const MorseSmaleComplex& complex) {
  return array_of<Quad>(complex.quad_count(), [&](Index i) { return complex.quad(i); });
}

Polylines polylines_of(const MorseSmaleComplex& complex, const core::Progress& progress) {
  progress.update("arcs", 0);
  const std::size_t arcs = complex.arc_count();
  Polylines result;
  result.offsets.assign(arcs + 1, 0);
  std::vector<std::vector<core::Point>> parts((arcs + kArcsTogether - 1) / kArcsTogether);
  core::parallel_for(0, arcs, kArcsTogether, [&](std::size_t first, std::size_t last) {
    std::vector<core::Point>& part = parts[first / kArcsTogether];
    std::vector<core::Point> arc;
    for (std::size_t a = first; a < last; ++a) {
      complex.trace(static_cast<Index>(a), arc);
      result.offsets[a + 1] = arc.size();
      part.insert(part.end(), arc.begin(), arc.end());
    }
  });
  progress.update("arcs", 0.5);
  for (std::size_t a = 0; a < arcs; ++a) result.offsets[a + 1] += result.offsets[a];
  result.points.resize(result.offsets.back());
  core::parallel_for(0, parts.size(), 1, [&](std::size_t i, std::size_t) {
    std::copy(parts[i].begin(), parts[i].end(), result.points.data() + result.offsets[i * kArcsTogether]);
    parts[i] = {};
  });
  progress.update("arcs", 1);
  return result;
}

}  // namespace morsel::mscomplex
