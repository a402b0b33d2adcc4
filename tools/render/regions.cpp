#include "morsel/tools/render/regions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "morsel/core/parallel/parallel.h"

namespace morsel::tools::render {
namespace {

using core::Index;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Paul Tol's "light" qualitative scheme (BSD), and whites between them.
constexpr std::array<std::uint32_t, 9> kLight = {0x77aadd, 0xee8866, 0xeedd88, 0xffaabb, 0x99ddff,
                                                 0x44bb99, 0xbbcc33, 0xaaaa00, 0xdddddd};

/// The k-th colour of an endless palette: tints and shades of the nine, ever farther apart in lightness.
Color palette_color(std::size_t k) {
  Eigen::Vector3f lab = to_oklab(from_hex(kLight[k % kLight.size()]));
  lab = Eigen::Vector3f(0.60f * lab[0] + 0.40f * 0.87f, 0.85f * lab[1],
                        0.85f * lab[2]);  // lighter: shading darkens
  const std::size_t round = k / kLight.size();
  constexpr std::array<float, 6> kShift = {0, -0.11f, 0.06f, -0.2f, -0.055f, -0.155f};
  lab[0] = std::clamp(lab[0] + kShift[round % kShift.size()], 0.3f, 0.96f);
  // Beyond these only the numbers differ, and the lightness slightly.
  const std::size_t lap = round / kShift.size();
  lab[0] -= 0.004f * static_cast<float>(lap);
  return from_oklab(lab).cwiseMax(0.f).cwiseMin(1.f);
}

}  // namespace

std::vector<std::uint32_t> color_graph(std::uint32_t nodes, std::span<const Edge> edges,
                                       std::vector<Color>& palette) {
  std::vector<Edge> both;
  both.reserve(2 * edges.size());
  for (const auto& [a, b] : edges) {
    if (a == b) continue;
    both.emplace_back(a, b);
    both.emplace_back(b, a);
  }
  std::sort(both.begin(), both.end());
  both.erase(std::unique(both.begin(), both.end()), both.end());
  std::vector<std::size_t> offset(nodes + std::size_t{1}, 0);
  for (const Edge& e : both) ++offset[e.first + 1];
  for (std::uint32_t i = 0; i < nodes; ++i) offset[i + 1] += offset[i];
  const auto neighbours = [&](std::uint32_t i) {
    return std::span<const Edge>(both).subspan(offset[i], offset[i + 1] - offset[i]);
  };

  palette.clear();
  std::vector<Eigen::Vector3f> lab;
  std::vector<std::size_t> used;
  const auto extend = [&] {
    for (std::size_t k = 0; k < kLight.size(); ++k) {
      palette.push_back(palette_color(palette.size()));
      lab.push_back(to_oklab(palette.back()));
      used.push_back(0);
    }
  };
  extend();
  extend();

  constexpr std::uint32_t kUncolored = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> color(nodes, kUncolored);
  std::vector<std::uint32_t> saturation(nodes,
                                        0);  // coloured neighbours: a node's different colours are no more
  // The most constrained node first: most coloured neighbours, then most neighbours, then the smallest
  // number.
  struct Key {
    std::uint32_t saturation;
    std::size_t degree;
    std::uint32_t node;
    bool operator<(const Key& o) const {
      if (saturation != o.saturation) return saturation > o.saturation;
      if (degree != o.degree) return degree > o.degree;
      return node < o.node;
    }
  };
  std::set<Key> queue;
  for (std::uint32_t i = 0; i < nodes; ++i) queue.insert({0, neighbours(i).size(), i});
  std::vector<float> nearest;
  while (!queue.empty()) {
    const std::uint32_t node = queue.begin()->node;
    queue.erase(queue.begin());
    for (;;) {
      nearest.assign(palette.size(), 1.f);
      for (const Edge& e : neighbours(node)) {
        const std::uint32_t other = color[e.second];
        if (other == kUncolored) continue;
        for (std::size_t k = 0; k < palette.size(); ++k)
          nearest[k] = k == other ? 0 : std::min(nearest[k], (lab[k] - lab[other]).norm());
      }
      std::size_t best = palette.size();
      // Among colours that are far enough the least used one, so that two colours do not dominate the
      // picture.
      constexpr float kEnough = 0.16f;
      for (std::size_t k = 0; k < palette.size(); ++k) {
        if (nearest[k] <= 0) continue;
        if (best == palette.size()) {
          best = k;
          continue;
        }
        const float here = std::min(nearest[k], kEnough), there = std::min(nearest[best], kEnough);
        if (here > there || (here == there && used[k] < used[best])) best = k;
      }
      if (best < palette.size()) {
        color[node] = static_cast<std::uint32_t>(best);
        ++used[best];
        break;
      }
      extend();
    }
    for (const Edge& e : neighbours(node)) {
      if (color[e.second] != kUncolored) continue;
      queue.erase({saturation[e.second], neighbours(e.second).size(), e.second});
      ++saturation[e.second];
      queue.insert({saturation[e.second], neighbours(e.second).size(), e.second});
    }
  }
  return color;
}

RegionColors color_segments(const core::TriangleMesh& mesh, const mscomplex::Segmentation& segmentation,
                            mscomplex::SegmentKind kind) {
  const std::size_t corners = mesh.halfedge_count();
  // A region is a pair of labels, of which a kind may use only one.
  using Pair = std::pair<Index, Index>;
  std::vector<Pair> label(corners);
  core::parallel_for_each(corners, [&](std::size_t h) {
    const Index v = mesh.origin(static_cast<Index>(h));
    const Index low = kind == mscomplex::SegmentKind::descending ? 0 : segmentation.ascending.vertex[v];
    const Index high =
        kind == mscomplex::SegmentKind::ascending ? 0 : segmentation.descending.triangle[h / 3];
    label[h] = {low, high};
  });
  std::vector<Pair> regions = label;
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  std::vector<std::uint32_t> region(corners);
  core::parallel_for_each(corners, [&](std::size_t h) {
    region[h] = static_cast<std::uint32_t>(std::lower_bound(regions.begin(), regions.end(), label[h]) -
                                           regions.begin());
  });
  std::vector<Edge> edges;
  const auto meet = [&](std::uint32_t a, std::uint32_t b) {
    if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
  };
  for (Index h = 0; h < corners; ++h) {
    const Index twin = mesh.twin(h);
    meet(region[h], region[core::TriangleMesh::next(h)]);
    if (twin != core::kNone)
      meet(region[h], region[core::TriangleMesh::next(twin)]);  // the same vertex, across
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  RegionColors result;
  result.corner = color_graph(static_cast<std::uint32_t>(regions.size()), edges, result.palette);
  std::vector<std::uint32_t> of_corner(corners);
  for (std::size_t h = 0; h < corners; ++h) of_corner[h] = result.corner[region[h]];
  result.corner = std::move(of_corner);
  return result;
}

}  // namespace morsel::tools::render
