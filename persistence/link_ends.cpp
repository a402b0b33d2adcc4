#include "morsel/persistence/link_ends.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;

constexpr std::size_t kTriangles = std::size_t{1} << 13;  // a chunk
constexpr std::size_t kSaddles = 128;                     // whose links are walked, a chunk

/// Calls visit(lower, higher) for each change in the link of v on the capped surface.
template <class Visit>
void for_each_change(const core::ScalarField& field, Index v, const Visit& visit) {
  const core::TriangleMesh& mesh = field.mesh();
  core::for_each_link_pair(
      mesh, v, [&](Index u) { return field.is_lower(u, v); },
      [&](const core::LinkElement& a, const core::LinkElement& b) {
        if (a.is_lower == b.is_lower) return;
        const Index higher = a.is_lower ? b.vertex : a.vertex;
        visit(a.is_lower ? a.vertex : b.vertex,
              higher == kNone ? mesh.vertex_count() + mesh.boundary_loop_of_vertex(v) : higher);
      });
}

/// Reserves an entry for each change of each saddle, in the order of the vertices.
LinkEnds make_room(const core::ScalarField& field, std::span<const core::LinkChanges> types,
                   std::span<const Saddle> saddles) {
  LinkEnds result;
  result.offset.resize(types.size());
  for (const Saddle& saddle : saddles)
    if (const Index v = field.order()[saddle.rank]; types[v].is_cut_off())
      result.offset[v] = saddle.changes();
  Index end = 0;
  for (std::size_t v = 0; v < types.size(); ++v) {
    const Index count = types[v].is_cut_off()  ? result.offset[v]
                        : types[v].is_saddle() ? types[v].changes()
                                               : 0;
    result.offset[v] = end;
    end += count;
  }
  result.lower.resize(end);
  result.higher.resize(end);
  return result;
}

/// One more pass over the triangles. Afterwards offsets are at the ends of their entries.
template <bool kShared>
void fill(const core::ScalarField& field, std::span<const core::LinkChanges> types, LinkEnds& ends,
          Paths& down_to_minima, Paths& up_to_maxima) {
  const core::TriangleMesh& mesh = field.mesh();
  const auto change = [&](Index lowest, Index middle, Index highest) {
    if (!types[middle].is_saddle()) return;
    const Index place =
        kShared ? std::atomic_ref<Index>(ends.offset[middle]).fetch_add(1, std::memory_order_relaxed)
                : ends.offset[middle]++;
    ends.lower[place] = lowest;
    ends.higher[place] = highest;
  };
  core::parallel_for(0, mesh.triangle_count(), kTriangles, [&](std::size_t first, std::size_t last) {
    core::for_each_triangle(mesh, field.ranks(), first, last, [&](Index lowest, Index middle, Index highest) {
      down_to_minima.set_next(middle, lowest);
      down_to_minima.set_next(highest, lowest);
      up_to_maxima.set_next(lowest, highest);
      up_to_maxima.set_next(middle, highest);
      change(lowest, middle, highest);
    });
  });
  core::for_each_cap_triangle(mesh, field.ranks(), [&](Index lowest, Index middle, Index cap) {
    up_to_maxima.set_next(lowest, cap);
    up_to_maxima.set_next(middle, cap);
    change(lowest, middle, cap);
  });
}

}  // namespace

LinkEnds link_ends(const core::ScalarField& field, std::span<const core::LinkChanges> types,
                   std::span<const Saddle> saddles, Paths& down_to_minima, Paths& up_to_maxima) {
  LinkEnds ends = make_room(field, types, saddles);
  if (saddles.size() < types.size() / 16) {  // walking their links is faster than a pass over all triangles
    core::parallel_for(0, saddles.size(), kSaddles, [&](std::size_t first, std::size_t last) {
      for (std::size_t s = first; s < last; ++s) {
        const Index v = field.order()[saddles[s].rank];
        Index place = ends.offset[v];
        for_each_change(field, v, [&](Index lower, Index higher) {
          ends.lower[place] = lower;
          ends.higher[place++] = higher;
        });
      }
    });
    return ends;
  }
  if (core::thread_count() == 1)
    fill<false>(field, types, ends, down_to_minima, up_to_maxima);
  else
    fill<true>(field, types, ends, down_to_minima, up_to_maxima);
  core::parallel_for_each(saddles.size(), [&](std::size_t s) {
    ends.offset[field.order()[saddles[s].rank]] -= saddles[s].changes();
  });
  return ends;
}

}  // namespace morsel::persistence::detail
