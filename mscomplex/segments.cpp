#include "morsel/mscomplex/segments.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/parallel_sort.h"
#include "morsel/core/parallel/partition.h"
#include "morsel/core/parallel/union_find.h"
#include "morsel/mscomplex/quad_regions.h"
#include "morsel/mscomplex/segment_measures.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

// Labels are minima, or maxima and then caps, or quads and then components of the mesh.
Segmenter::Segmenter(const core::ScalarField& field, const PersistenceHierarchy& hierarchy, SegmentKind kind,
                     const core::Progress& progress)
    : hierarchy_(hierarchy), kind_(kind) {
  const MorseSmaleComplex& complex = hierarchy.complex();
  Segmentation base = segment(field, complex.gradient(), progress);
  if (kind == SegmentKind::ascending) {
    for (Index i = 0; i < complex.minimum_count(); ++i) ends_.push_back({i, kNone});
  } else if (kind == SegmentKind::descending) {
    for (Index n = complex.maximum_node(0); n < complex.node_count(); ++n) ends_.push_back({kNone, n});
  } else {
    label_by_quads(field, base);
  }
  choose_triangles(base);
  if (kind != SegmentKind::morse_smale)
    label_ = std::move((kind == SegmentKind::ascending ? base.ascending : base.descending).triangle);
  first_.assign(ends_.size(), kNone);
  for (auto t = static_cast<Index>(label_.size()); t-- > 0;) first_[label_[t]] = t;
}

void Segmenter::label_by_quads(const core::ScalarField& field, const Segmentation& base) {
  const MorseSmaleComplex& complex = hierarchy_.complex();
  const TriangleMesh& mesh = complex.mesh();
  label_ = quad_of_triangles(field, complex);
  const Index quads = complex.quad_count();
  ends_.resize(quads + mesh.component_count());
  core::parallel_for_each(quads, [&](std::size_t q) {
    const Quad quad = complex.quad(static_cast<Index>(q));
    ends_[q] = {quad.nodes[0], quad.nodes[2]};
  });
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (label_[t] != kNone) continue;  // all unlabelled ones of a component have the same ends
    label_[t] = quads + mesh.component_of_vertex(mesh.triangle(t)[0]);
    ends_[label_[t]] = {base.ascending.triangle[t], complex.maximum_node(base.descending.triangle[t])};
  }
}

/// A triangle whose own minimum and top are those of the vertex, as far as they matter for the kind.
void Segmenter::choose_triangles(const Segmentation& base) {
  const TriangleMesh& mesh = hierarchy_.complex().mesh();
  vertex_triangle_.resize(mesh.vertex_count());
  core::parallel_for_each(vertex_triangle_.size(), [&](std::size_t v) {
    Index best = kNone;
    int best_match = -1;
    mesh.for_each_outgoing(static_cast<Index>(v), [&](Index h) {
      const Index t = TriangleMesh::triangle_of(h);
      const int minimum = base.ascending.triangle[t] == base.ascending.vertex[v] ? 2 : 0;
      const int top = base.descending.triangle[t] == base.descending.vertex[v] ? 1 : 0;
      const int match = kind_ == SegmentKind::ascending    ? minimum
                        : kind_ == SegmentKind::descending ? top
                                                           : minimum + top;
      if (match > best_match) best = t;
      best_match = std::max(best_match, match);
    });
    vertex_triangle_[v] = best;
  });
}

/// The classes of labels that are one segment at a level. A class is named after one of its labels.
struct Segmenter::Merged {
  std::vector<Index> class_of;       // per label
  std::vector<std::uint8_t> is_cap;  // per label: whether it belongs to a cap now; empty where there are none
  std::vector<Index> first;          // per class: its smallest triangle, or kNone; except those of caps
  std::optional<core::ConcurrentUnionFind> pieces;  // of the triangles of caps, if there are any

  bool is_in_pieces(Index class_label) const { return !is_cap.empty() && is_cap[class_label] != 0; }
};

Segmenter::Merged Segmenter::merge(Index level) const {
  const MorseSmaleComplex& complex = hierarchy_.complex();
  if (level > hierarchy_.levels())
    throw core::InvalidArgument("the hierarchy has levels 0 to " + std::to_string(hierarchy_.levels()) +
                                ", none is " + std::to_string(level));
  Merged merged;
  merged.class_of = kind_ == SegmentKind::morse_smale ? quad_classes(level) : extremum_classes(level);
  if (kind_ != SegmentKind::ascending && !complex.mesh().is_closed()) {
    merged.is_cap.resize(ends_.size());
    core::parallel_for_each(ends_.size(), [&](std::size_t i) {
      merged.is_cap[i] = hierarchy_.survivor(ends_[i][1], level) >= complex.cap_node(0) ? 1 : 0;
    });
  }
  merged.first.assign(ends_.size(), kNone);
  for (Index i = 0; i < ends_.size(); ++i) {
    const Index c = merged.class_of[i];
    if (!merged.is_in_pieces(c)) merged.first[c] = std::min(merged.first[c], first_[i]);
  }
  if (!merged.is_cap.empty()) find_pieces(merged);
  return merged;
}

std::vector<Index> Segmenter::extremum_classes(Index level) const {
  const std::size_t end = kind_ == SegmentKind::ascending ? 0 : 1;
  const Index first_node = end == 0 ? 0 : hierarchy_.complex().maximum_node(0);
  std::vector<Index> class_of(ends_.size());
  core::parallel_for_each(ends_.size(), [&](std::size_t i) {
    class_of[i] = hierarchy_.survivor(ends_[i][end], level) - first_node;
  });
  return class_of;
}

/// Calls visit(a, b) for the quads that a cancellation joins: those on both sides of the arcs of the other
/// kind at its saddle.
template <class Visit>
void Segmenter::for_each_join(const Cancellation& c, const Visit& visit) const {
  const MorseSmaleComplex& complex = hierarchy_.complex();
  for (const Index side : {1, 3}) {
    const Index arc = c.arc - c.arc % 4 + (c.arc + side) % 4;
    visit(complex.quad_left_of(arc), complex.quad_right_of(arc));
  }
}

std::vector<Index> Segmenter::quad_classes(Index level) const {
  core::UnionFind sets(static_cast<Index>(ends_.size()));
  for (const Cancellation& c : hierarchy_.cancellations().first(level))
    for_each_join(c, [&](Index a, Index b) { sets.unite(a, b); });
  std::vector<Index> class_of(ends_.size());
  for (Index i = 0; i < class_of.size(); ++i) class_of[i] = sets.find(i);
  return class_of;
}

/// Without caps, whose pieces would have to be counted at each level.
Index Segmenter::level_with_quads(Index wanted) const {
  core::UnionFind sets(static_cast<Index>(ends_.size()));
  std::vector<std::uint8_t> is_used(ends_.size());
  Index used = 0;
  for (Index i = 0; i < ends_.size(); ++i) used += is_used[i] = first_[i] != kNone ? 1 : 0;
  Index level = 0;
  for (; level < hierarchy_.levels() && used > wanted; ++level)
    for_each_join(hierarchy_.cancellations()[level], [&](Index a, Index b) {
      a = sets.find(a);
      b = sets.find(b);
      if (!sets.unite(a, b)) return;
      used -= is_used[a] & is_used[b];
      is_used[std::min(a, b)] = is_used[a] | is_used[b];
    });
  return level;
}

void Segmenter::find_pieces(Merged& merged) const {
  const TriangleMesh& mesh = hierarchy_.complex().mesh();
  core::ConcurrentUnionFind& pieces = merged.pieces.emplace(mesh.triangle_count());
  const auto class_of_triangle = [&](Index t) { return merged.class_of[label_[t]]; };
  if (kind_ == SegmentKind::descending) {
    core::parallel_for_each(mesh.halfedge_count(), [&](std::size_t i) {
      const auto h = static_cast<Index>(i);
      const Index across = mesh.twin(h);
      if (across == kNone || across < h) return;
      const Index a = TriangleMesh::triangle_of(h);
      const Index b = TriangleMesh::triangle_of(across);
      if (class_of_triangle(a) == class_of_triangle(b) && merged.is_in_pieces(class_of_triangle(a)))
        pieces.unite(a, b);
    });
    return;
  }
  core::parallel_for(0, mesh.vertex_count(), core::kGrain, [&](std::size_t first, std::size_t last) {
    std::vector<std::array<Index, 2>> star;  // class, triangle
    for (auto v = static_cast<Index>(first); v < last; ++v) {
      star.clear();
      mesh.for_each_outgoing(v, [&](Index h) {
        const Index t = TriangleMesh::triangle_of(h);
        if (merged.is_in_pieces(class_of_triangle(t))) star.push_back({class_of_triangle(t), t});
      });
      std::sort(star.begin(), star.end());
      for (std::size_t i = 1; i < star.size(); ++i)
        if (star[i - 1][0] == star[i][0]) pieces.unite(star[i - 1][1], star[i][1]);
    }
  });
}

Index Segmenter::count(Index level) const {
  const MorseSmaleComplex& complex = hierarchy_.complex();
  if (kind_ == SegmentKind::ascending) return hierarchy_.minimum_count(level);
  if (kind_ == SegmentKind::descending && complex.mesh().is_closed()) return hierarchy_.maximum_count(level);
  Merged merged = merge(level);
  const auto number_of_classes =
      std::count_if(merged.first.begin(), merged.first.end(), [](Index t) { return t != kNone; });
  if (!merged.pieces) return static_cast<Index>(number_of_classes);
  return core::parallel_reduce(
      0, label_.size(), core::kGrain, static_cast<Index>(number_of_classes),
      [&](std::size_t begin, std::size_t end) {
        Index roots = 0;
        for (auto t = static_cast<Index>(begin); t < end; ++t)
          roots += merged.is_in_pieces(merged.class_of[label_[t]]) && merged.pieces->find(t) == t ? 1 : 0;
        return roots;
      },
      [](Index a, Index b) { return a + b; });
}

Index Segmenter::level_with(Index wanted) const {
  if (kind_ == SegmentKind::morse_smale && hierarchy_.complex().mesh().is_closed())
    return level_with_quads(wanted);
  Index low = 0;
  Index high = hierarchy_.levels();
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    if (count(middle) <= wanted)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

Segments Segmenter::segments(Index level, const core::Progress& progress) const {
  progress.update("segments", 0);
  Merged merged = merge(level);
  progress.update("segments", 0.2);
  Segments result;
  result.kind = kind_;
  result.level = level;
  number(merged, result);
  progress.update("segments", 0.4);
  find_saddles(merged, result);
  progress.update("segments", 0.5);
  measure_segments(hierarchy_.complex().mesh(), result);
  progress.update("segments", 1);
  return result;
}

void Segmenter::number(Merged& merged, Segments& result) const {
  struct Found {
    Index minimum, top, first, name;  // kNone is the greatest; all segments of a kind have it, or none
    auto key() const { return std::tuple(minimum, top, first); }
  };
  std::vector<Found> found;
  for (Index c = 0; c < merged.first.size(); ++c)
    if (merged.first[c] != kNone) found.push_back({kNone, kNone, merged.first[c], c});
  const auto is_piece = [&](Index t) { return merged.is_in_pieces(merged.class_of[label_[t]]); };
  if (merged.pieces)
    for (Index t = 0; t < label_.size(); ++t)
      if (is_piece(t) && merged.pieces->find(t) == t) found.push_back({kNone, kNone, t, kNone});
  const auto alive = [&](Index node) {
    return node == kNone ? kNone : hierarchy_.survivor(node, result.level);
  };
  core::parallel_for_each(found.size(), [&](std::size_t i) {
    const auto& [minimum, top] = ends_[label_[found[i].first]];
    found[i].minimum = alive(minimum);
    found[i].top = alive(top);
  });
  core::parallel_sort(found.begin(), found.end(),
                      [](const Found& a, const Found& b) { return a.key() < b.key(); });

  result.segments.resize(found.size());
  result.triangle.resize(label_.size());
  std::vector<Index> number_of_class(ends_.size(), kNone);
  for (Index s = 0; s < found.size(); ++s) {
    result.segments[s].minimum = found[s].minimum;
    result.segments[s].top = found[s].top;
    if (found[s].name == kNone)
      result.triangle[found[s].first] = s;
    else
      number_of_class[found[s].name] = s;
  }
  core::parallel_for_each(label_.size(), [&](std::size_t i) {
    const auto t = static_cast<Index>(i);
    if (!is_piece(t)) {
      result.triangle[t] = number_of_class[merged.class_of[label_[t]]];
      return;
    }
    const Index root = merged.pieces->find(t);
    if (root != t) result.triangle[t] = result.triangle[root];
  });
  result.vertex.resize(vertex_triangle_.size());
  core::parallel_for_each(result.vertex.size(),
                          [&](std::size_t v) { result.vertex[v] = result.triangle[vertex_triangle_[v]]; });
}

/// The labels at level 0 of the extrema at the ends of a saddle's arcs, or of the quads around it.
std::array<Index, 4> Segmenter::labels_around(Index saddle) const {
  const MorseSmaleComplex& complex = hierarchy_.complex();
  const Index down = 4 * saddle;
  if (kind_ == SegmentKind::morse_smale)
    return {complex.quad_left_of(down), complex.quad_right_of(down), complex.quad_left_of(down + 2),
            complex.quad_right_of(down + 2)};
  const bool ascending = kind_ == SegmentKind::ascending;
  const Index a = complex.arc_end(down + (ascending ? 0 : 1));
  const Index b = complex.arc_end(down + (ascending ? 2 : 3));
  const Index first = ascending ? 0 : complex.maximum_node(0);
  return {a - first, b - first, a - first, b - first};
}

/// A segment that a saddle is joined to has a triangle beside the saddle's vertex: one that has its critical
/// edge, or one that has the edge by which its vertex descends. Of the pieces of a cap's region, those that
/// have one.
void Segmenter::find_saddles(const Merged& merged, Segments& result) const {
  const MorseSmaleComplex& complex = hierarchy_.complex();
  const TriangleMesh& mesh = complex.mesh();
  const auto saddles = complex.gradient().saddles();
  using Entry = std::array<Index, 2>;  // segment, saddle vertex
  const auto all =
      core::partition<Entry>(saddles.size(), 1, 1024, [&](std::size_t first, std::size_t last, auto&& emit) {
        std::vector<Index> joined;
        std::vector<Index> found;
        for (std::size_t i = first; i < last; ++i) {
          const Index v = saddles[i].vertex;
          if (i > 0 && saddles[i - 1].vertex == v) continue;  // one pass for all saddles at a vertex
          joined.clear();
          for (std::size_t k = i; k < saddles.size() && saddles[k].vertex == v; ++k)
            if (hierarchy_.is_alive(complex.saddle_node(static_cast<Index>(k)), result.level))
              for (const Index label : labels_around(static_cast<Index>(k)))
                joined.push_back(merged.class_of[label]);
          if (joined.empty()) continue;
          std::sort(joined.begin(), joined.end());
          found.clear();
          mesh.for_each_outgoing(v, [&](Index h) {
            const Index t = TriangleMesh::triangle_of(h);
            if (std::binary_search(joined.begin(), joined.end(), merged.class_of[label_[t]]))
              found.push_back(result.triangle[t]);
          });
          std::sort(found.begin(), found.end());
          found.erase(std::unique(found.begin(), found.end()), found.end());
          for (const Index s : found) emit(0, Entry{s, v});
        }
      });
  result.saddle_offset.assign(result.segments.size() + 1, 0);
  for (const Entry& entry : all.items) ++result.saddle_offset[entry[0] + 1];
  for (std::size_t s = 0; s < result.segments.size(); ++s)
    result.saddle_offset[s + 1] += result.saddle_offset[s];
  result.saddle.resize(all.items.size());
  std::vector<Index> place(result.saddle_offset.begin(), result.saddle_offset.end() - 1);
  for (const Entry& entry : all.items) result.saddle[place[entry[0]]++] = entry[1];
}

}  // namespace morsel::mscomplex
