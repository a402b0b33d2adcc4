#include "morsel/tools/color/regions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "morsel/core/parallel/parallel.h"

namespace morsel::tools {
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

constexpr std::uint32_t kUncolored = std::numeric_limits<std::uint32_t>::max();

/// The neighbours of each node, ascending.
class GraphNeighbors {
 public:
  GraphNeighbors(std::uint32_t nodes, std::span<const Edge> edges) : offset_(nodes + std::size_t{1}, 0) {
    both_.reserve(2 * edges.size());
    for (const auto& [a, b] : edges) {
      if (a == b) continue;
      both_.emplace_back(a, b);
      both_.emplace_back(b, a);
    }
    std::sort(both_.begin(), both_.end());
    both_.erase(std::unique(both_.begin(), both_.end()), both_.end());
    for (const Edge& e : both_) ++offset_[e.first + 1];
    for (std::uint32_t i = 0; i < nodes; ++i) offset_[i + 1] += offset_[i];
  }

  std::size_t degree(std::uint32_t i) const { return offset_[i + 1] - offset_[i]; }
  /// As edges from i to them.
  std::span<const Edge> of(std::uint32_t i) const {
    return std::span<const Edge>(both_).subspan(offset_[i], degree(i));
  }

 private:
  std::vector<Edge> both_;
  std::vector<std::size_t> offset_;
};

/// Colours the nodes of a graph, the most constrained one first.
class GraphColoring {
 public:
  GraphColoring(std::uint32_t nodes, std::span<const Edge> edges, std::vector<Color>& palette)
      : neighbors_(nodes, edges), palette_(palette), color_(nodes, kUncolored), saturation_(nodes, 0) {
    palette_.clear();
    extend();
    extend();
    for (std::uint32_t i = 0; i < nodes; ++i) queue_.insert(key(i));
  }

  std::vector<std::uint32_t> run() {
    while (!queue_.empty()) {
      const std::uint32_t node = queue_.begin()->node;
      queue_.erase(queue_.begin());
      std::size_t color = best_color(node);
      for (; color == palette_.size(); color = best_color(node)) extend();
      color_[node] = static_cast<std::uint32_t>(color);
      ++used_[color];
      for (const Edge& e : neighbors_.of(node)) {
        if (color_[e.second] != kUncolored) continue;
        queue_.erase(key(e.second));
        ++saturation_[e.second];
        queue_.insert(key(e.second));
      }
    }
    return std::move(color_);
  }

 private:
  /// Most coloured neighbours, then most neighbours, then the smallest number.
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
  Key key(std::uint32_t node) const { return {saturation_[node], neighbors_.degree(node), node}; }

  void extend() {
    for (std::size_t k = 0; k < kLight.size(); ++k) {
      palette_.push_back(palette_color(palette_.size()));
      lab_.push_back(to_oklab(palette_.back()));
      used_.push_back(0);
    }
  }

  /// Among colours that are far enough from the neighbours' the least used one, so that two colours do not
  /// dominate the picture; the palette's size if the neighbours have all.
  std::size_t best_color(std::uint32_t node) {
    nearest_.assign(palette_.size(), 1.f);
    for (const Edge& e : neighbors_.of(node)) {
      const std::uint32_t other = color_[e.second];
      if (other == kUncolored) continue;
      for (std::size_t k = 0; k < palette_.size(); ++k)
        nearest_[k] = k == other ? 0 : std::min(nearest_[k], (lab_[k] - lab_[other]).norm());
    }
    constexpr float kEnough = 0.16f;
    std::size_t best = palette_.size();
    for (std::size_t k = 0; k < palette_.size(); ++k) {
      if (nearest_[k] <= 0) continue;
      if (best == palette_.size()) {
        best = k;
        continue;
      }
      const float here = std::min(nearest_[k], kEnough), there = std::min(nearest_[best], kEnough);
      if (here > there || (here == there && used_[k] < used_[best])) best = k;
    }
    return best;
  }

  GraphNeighbors neighbors_;
  std::vector<Color>& palette_;
  std::vector<Eigen::Vector3f> lab_;  // per colour
  std::vector<std::size_t> used_;     // per colour
  std::vector<float> nearest_;        // per colour: the distance of the node's nearest coloured neighbour
  std::vector<std::uint32_t> color_;  // per node
  std::vector<std::uint32_t> saturation_;  // coloured neighbours: a node's different colours are no more
  std::set<Key> queue_;
};

}  // namespace

std::vector<std::uint32_t> color_graph(std::uint32_t nodes, std::span<const Edge> edges,
                                       std::vector<Color>& palette) {
  return GraphColoring(nodes, edges, palette).run();
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

std::vector<Color> color_labels(const core::TriangleMesh& mesh, std::span<const Index> vertex,
                                std::span<const Index> triangle) {
  Index labels = 0;
  for (const std::span<const Index> list : {vertex, triangle})
    for (const Index label : list) labels = std::max(labels, label + 1);
  std::vector<Edge> edges;
  const auto meet = [&](Index a, Index b) {
    if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
  };
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index here = triangle[core::TriangleMesh::triangle_of(h)];
    meet(here, vertex[mesh.origin(h)]);
    meet(vertex[mesh.origin(h)], vertex[mesh.target(h)]);
    const Index twin = mesh.twin(h);
    if (twin != core::kNone) meet(here, triangle[core::TriangleMesh::triangle_of(twin)]);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<Color> palette;
  const std::vector<std::uint32_t> numbers = color_graph(labels, edges, palette);
  std::vector<Color> colors;
  colors.reserve(labels);
  for (const std::uint32_t number : numbers) colors.push_back(palette[number]);
  return colors;
}

}  // namespace morsel::tools
