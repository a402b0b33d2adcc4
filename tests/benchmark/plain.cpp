#include "benchmark/plain.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "morsel/core/parallel/union_find.h"

namespace morsel::benchmark::plain {
namespace {

using core::Index;

std::vector<std::vector<Index>> neighbors_of(const core::TriangleMesh& mesh) {
  std::vector<std::vector<Index>> neighbors(mesh.vertex_count());
  for (const core::Triangle& t : mesh.triangles())
    for (std::size_t i = 0; i < 3; ++i)
      neighbors[t[i]].push_back(t[(i + 1) % 3]);  // closed: each edge both ways
  return neighbors;
}

std::size_t pairs_upwards(const std::vector<std::vector<Index>>& neighbors, const std::vector<Index>& order) {
  std::vector<Index> rank(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<Index>(i);
  core::UnionFind sets(static_cast<Index>(order.size()));  // of ranks: the root of a set is its lowest
  std::size_t pairs = 0;
  for (Index i = 0; i < order.size(); ++i) {
    std::size_t merged = 0;
    for (const Index u : neighbors[order[i]])
      if (rank[u] < i && sets.unite(i, rank[u])) ++merged;
    pairs += merged > 1 ? merged - 1 : 0;
  }
  return pairs;
}

}  // namespace

std::size_t edges(std::span<const core::Triangle> triangles) {
  std::unordered_map<std::uint64_t, Index> number;
  for (const core::Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
      number.emplace(std::uint64_t{a} << 32 | b, static_cast<Index>(number.size()));
    }
  return number.size();
}

std::vector<core::Index> order(std::span<const double> values) {
  std::vector<Index> result(values.size());
  std::iota(result.begin(), result.end(), Index{0});
  std::sort(result.begin(), result.end(),
            [&](Index a, Index b) { return values[a] < values[b] || (values[a] == values[b] && a < b); });
  return result;
}

std::size_t critical_points(const core::TriangleMesh& mesh, std::span<const Index> rank) {
  std::vector<std::vector<Index>> star(mesh.vertex_count());
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    for (const Index v : mesh.triangle(t)) star[v].push_back(t);
  std::size_t total = 0;
  std::vector<Index> ring;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    ring.clear();
    for (const Index t : star[v])
      for (const Index u : mesh.triangle(t))
        if (u != v) ring.push_back(u);
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    const auto place = [&](Index u) {
      return static_cast<Index>(std::lower_bound(ring.begin(), ring.end(), u) - ring.begin());
    };
    core::UnionFind sets(static_cast<Index>(ring.size()));
    const auto is_lower = [&](Index u) { return rank[u] < rank[v]; };
    std::size_t components[2] = {0, 0};  // upper, lower
    for (const Index u : ring) ++components[is_lower(u) ? 1 : 0];
    for (const Index t : star[v]) {
      Index opposite[2];
      Index* end = opposite;
      for (const Index u : mesh.triangle(t))
        if (u != v) *end++ = u;
      if (is_lower(opposite[0]) == is_lower(opposite[1]) &&
          sets.unite(place(opposite[0]), place(opposite[1])))
        --components[is_lower(opposite[0]) ? 1 : 0];
    }
    if (components[0] != 1 || components[1] != 1) ++total;
  }
  return total;
}

std::size_t pairs(const core::TriangleMesh& mesh, std::span<const Index> rank) {
  const auto neighbors = neighbors_of(mesh);
  std::vector<Index> order(rank.size());
  for (std::size_t v = 0; v < rank.size(); ++v) order[rank[v]] = static_cast<Index>(v);
  const std::size_t upwards = pairs_upwards(neighbors, order);
  std::reverse(order.begin(), order.end());
  return upwards + pairs_upwards(neighbors, order);
}

}  // namespace morsel::benchmark::plain
