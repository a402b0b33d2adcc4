#include "morsel/mscomplex/segmentation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/mscomplex/follow.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

std::string to_string(SegmentKind kind) {
  return kind == SegmentKind::descending  ? "descending"
         : kind == SegmentKind::ascending ? "ascending"
                                          : "morse-smale";
}

namespace {

using Pair = std::uint64_t;  // ascending label, descending label
Pair make_pair(Index minimum, Index top) { return Pair{minimum} << 32 | top; }
Index minimum_of(Pair pair) { return static_cast<Index>(pair >> 32); }
Index top_of(Pair pair) { return static_cast<Index>(pair); }

class SegmentLabeling {
 public:
  SegmentLabeling(const core::ScalarField& field, const DiscreteGradient& gradient)
      : mesh_(gradient.mesh()), rank_(field.ranks()), gradient_(gradient) {}

  void follow_vertices() {
    auto& label = result_.ascending.vertex;
    const auto descents = gradient_.descents();
    label.assign(descents.begin(), descents.end());
    const auto minima = gradient_.minima();
    for (std::size_t i = 0; i < minima.size(); ++i) label[minima[i]] = static_cast<Index>(i) | kPathEnd;
    follow_all(label);
    result_.ascending.count = static_cast<Index>(minima.size());
  }

  void follow_triangles() {
    auto& label = result_.descending.triangle;
    label.resize(mesh_.triangle_count());
    core::parallel_for_each(label.size(),
                            [&](std::size_t t) { label[t] = gradient_.ascend(static_cast<Index>(t)); });
    const auto maxima = gradient_.maxima();
    for (std::size_t i = 0; i < maxima.size(); ++i) label[maxima[i].cell] = static_cast<Index>(i) | kPathEnd;
    result_.descending.count = static_cast<Index>(maxima.size());
    for (Index k = 0; k < mesh_.boundary_loop_count(); ++k) {
      bool empty = true;
      for (const Index h : mesh_.boundary_loop(k))
        if (gradient_.is_paired(h)) {
          label[TriangleMesh::triangle_of(h)] = (static_cast<Index>(maxima.size()) + k) | kPathEnd;
          empty = false;
        }
      if (!empty) ++result_.descending.count;
    }
    follow_all(label);
  }

  /// Labels of triangles from those of vertices, and vice versa.
  void carry_over() {
    auto& of_triangle = result_.ascending.triangle;
    of_triangle.resize(mesh_.triangle_count());
    core::parallel_for_each(of_triangle.size(), [&](std::size_t t) {
      const auto& [a, b, c] = mesh_.triangle(static_cast<Index>(t));
      const Index lower = rank_[a] < rank_[b] ? a : b;
      of_triangle[t] = result_.ascending.vertex[rank_[lower] < rank_[c] ? lower : c];
    });
    auto& of_vertex = result_.descending.vertex;
    of_vertex.resize(mesh_.vertex_count());
    core::parallel_for_each(of_vertex.size(), [&](std::size_t v) {
      of_vertex[v] = result_.descending.triangle[highest_triangle(static_cast<Index>(v))];
    });
  }

  void pair_up() {
    collect_triangle_pairs();
    label_triangles();
    label_vertices();
  }

  Segmentation take() { return std::move(result_); }

 private:
  /// All triangles of a star share the vertex, so their other two corners decide.
  Index highest_triangle(Index v) const {
    const Index start = mesh_.vertex_halfedge(v);
    Index best = start;
    Pair best_ranks = 0;
    Index a = rank_[mesh_.target(start)];
    mesh_.for_each_outgoing(v, [&](Index h) {
      const Index b = rank_[mesh_.apex(h)];  // also the target of the next
      const Pair ranks = Pair{std::max(a, b)} << 32 | std::min(a, b);
      best = ranks > best_ranks ? h : best;
      best_ranks = std::max(ranks, best_ranks);
      a = b;
    });
    return TriangleMesh::triangle_of(best);
  }

  Pair triangle_pair(std::size_t t) const {
    return make_pair(result_.ascending.triangle[t], result_.descending.triangle[t]);
  }

  /// The pairs of a chunk of triangles, most of the repeated ones left out.
  std::vector<Pair> pairs_of_chunk(std::size_t first, std::size_t last) const {
    constexpr std::size_t kSlots = 1024;
    constexpr Pair kEmpty = ~Pair{0};
    std::vector<Pair> latest(kSlots, kEmpty);
    std::vector<Pair> pairs;
    for (std::size_t t = first; t < last; ++t) {
      const Pair pair = triangle_pair(t);
      Pair& slot = latest[(pair * 0x9E37'79B9'7F4A'7C15u) >> 54];
      if (slot == pair) continue;
      slot = pair;
      pairs.push_back(pair);
    }
    return pairs;
  }

  /// Fills tops_ with the distinct maxima paired with each minimum, ascending, from first_[minimum] on.
  void collect_triangle_pairs() {
    constexpr std::size_t kChunk = 16384;
    const std::vector<Pair> pairs = core::parallel_reduce(
        0, mesh_.triangle_count(), kChunk, std::vector<Pair>{},
        [&](std::size_t first, std::size_t last) { return pairs_of_chunk(first, last); },
        [](std::vector<Pair> sum, const std::vector<Pair>& part) {
          sum.insert(sum.end(), part.begin(), part.end());
          return sum;
        });
    const std::size_t minima = gradient_.minima().size();
    std::vector<std::size_t> offset(minima + 1, 0);
    for (const Pair pair : pairs) ++offset[minimum_of(pair) + 1];
    for (std::size_t i = 0; i < minima; ++i) offset[i + 1] += offset[i];
    std::vector<Index> tops(pairs.size());
    {
      std::vector<std::size_t> cursor(offset.begin(), offset.end() - 1);
      for (const Pair pair : pairs) tops[cursor[minimum_of(pair)]++] = top_of(pair);
    }
    first_.assign(minima + 1, 0);
    core::parallel_for_each(minima, [&](std::size_t i) {
      const auto begin = tops.begin() + static_cast<std::ptrdiff_t>(offset[i]);
      const auto end = tops.begin() + static_cast<std::ptrdiff_t>(offset[i + 1]);
      std::sort(begin, end);
      first_[i + 1] = static_cast<Index>(std::unique(begin, end) - begin);
    });
    for (std::size_t i = 0; i < minima; ++i) first_[i + 1] += first_[i];
    tops_.resize(first_[minima]);
    result_.cells.resize(first_[minima]);
    core::parallel_for_each(minima, [&](std::size_t i) {
      for (Index j = first_[i]; j < first_[i + 1]; ++j) {
        tops_[j] = tops[offset[i] + (j - first_[i])];
        result_.cells[j] = {static_cast<Index>(i), tops_[j]};
      }
    });
    result_.morse_smale.count = first_[minima];
  }

  /// The label of a pair; kNone if no triangle carries it.
  Index label_of(Pair pair) const {
    const auto begin = tops_.begin() + first_[minimum_of(pair)];
    const auto end = tops_.begin() + first_[minimum_of(pair) + 1];
    const auto found = std::lower_bound(begin, end, top_of(pair));
    return found == end || *found != top_of(pair) ? kNone : static_cast<Index>(found - tops_.begin());
  }

  void label_triangles() {
    auto& label = result_.morse_smale.triangle;
    label.resize(mesh_.triangle_count());
    core::parallel_for_each(label.size(), [&](std::size_t t) { label[t] = label_of(triangle_pair(t)); });
  }

  void label_vertices() {
    auto& label = result_.morse_smale.vertex;
    label.resize(mesh_.vertex_count());
    const auto vertex_pair = [&](std::size_t v) {
      return make_pair(result_.ascending.vertex[v], result_.descending.vertex[v]);
    };
    core::parallel_for_each(label.size(), [&](std::size_t v) { label[v] = label_of(vertex_pair(v)); });
    std::vector<Pair> more;
    for (std::size_t v = 0; v < label.size(); ++v)
      if (label[v] == kNone) more.push_back(vertex_pair(v));
    if (more.empty()) return;
    std::sort(more.begin(), more.end());
    more.erase(std::unique(more.begin(), more.end()), more.end());
    for (std::size_t v = 0; v < label.size(); ++v)
      if (label[v] == kNone)
        label[v] =
            result_.morse_smale.count +
            static_cast<Index>(std::lower_bound(more.begin(), more.end(), vertex_pair(v)) - more.begin());
    for (const Pair pair : more) result_.cells.push_back({minimum_of(pair), top_of(pair)});
  }

  const TriangleMesh& mesh_;
  std::span<const Index> rank_;
  const DiscreteGradient& gradient_;
  std::vector<Index> first_;  // per minimum, and the end
  std::vector<Index> tops_;
  Segmentation result_;
};

}  // namespace

Segmentation segment(const core::ScalarField& field, const DiscreteGradient& gradient,
                     const core::Progress& progress) {
  if (!gradient.mesh().is_same(field.mesh()))
    throw core::InvalidArgument("the gradient is on another mesh than the field: compute it from this field");
  progress.update("segmentation", 0);
  SegmentLabeling labeling(field, gradient);
  labeling.follow_vertices();
  progress.update("segmentation", 0.2);
  labeling.follow_triangles();
  progress.update("segmentation", 0.4);
  labeling.carry_over();
  progress.update("segmentation", 0.7);
  labeling.pair_up();
  progress.update("segmentation", 1);
  return labeling.take();
}

}  // namespace morsel::mscomplex
