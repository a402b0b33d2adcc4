// Cancelling critical cells of a discrete gradient.

#include <algorithm>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/mscomplex/discrete_gradient.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

namespace {

[[noreturn]] void refuse(Index arc, const char* why) {
  throw core::InvalidArgument("side " + std::to_string(arc % 4) + " of saddle " + std::to_string(arc / 4) +
                              " cannot be cancelled: " + why);
}

}  // namespace

DiscreteGradient DiscreteGradient::with_reversed(std::span<const Index> arcs) const {
  DiscreteGradient result = *this;
  std::vector<bool> gone(saddles_.size(), false);
  for (const Index arc : arcs) {
    if (arc / 4 >= saddles_.size()) refuse(arc, "there is no such saddle");
    if (gone[arc / 4]) refuse(arc, "the saddle is cancelled already");
    gone[arc / 4] = true;
    if (arc % 2 == 0)
      result.reverse_descent(saddles_[arc / 4].cell, arc);
    else
      result.reverse_ascent(saddles_[arc / 4].cell, arc);
  }
  Index i = 0;
  std::erase_if(result.saddles_, [&](const CriticalCell&) { return gone[i++]; });
  std::erase_if(result.minima_, [&](Index v) { return result.lower_[v] != kNone; });
  std::erase_if(result.maxima_, [&](const CriticalCell& m) { return result.side_[m.cell] != kCritical; });
  return result;
}

void DiscreteGradient::reverse_descent(Index edge, Index arc) {
  const Index h = mesh_.edge_halfedge(edge);
  const Index start = arc % 4 == 0 ? mesh_.origin(h) : mesh_.target(h);
  const Index other = arc % 4 == 0 ? mesh_.target(h) : mesh_.origin(h);
  Index end = start;
  while (lower_[end] != kNone) end = lower_[end];
  Index v = other;
  while (lower_[v] != kNone) v = lower_[v];
  if (v == end) refuse(arc, "its other side of this kind ends in the same minimum");
  Index behind = other;
  for (v = start; v != kNone;) {
    const Index next = lower_[v];
    lower_[v] = behind;
    behind = v;
    v = next;
  }
}

void DiscreteGradient::reverse_ascent(Index edge, Index arc) {
  const Index left = mesh_.edge_halfedge(edge);
  const Index entry = arc % 4 == 3 ? left : mesh_.twin(left);
  const Index other = arc % 4 == 3 ? mesh_.twin(left) : left;
  // Where a V-path up ends: at a triangle, or at the boundary half-edge by which it leaves the surface.
  const auto top_half_edge = [&](Index h) {
    for (;;) {
      if (h == kNone) return kNone;
      const Index exit = paired_halfedge(TriangleMesh::triangle_of(h));
      if (exit == kNone) return h;
      h = mesh_.twin(exit);
    }
  };
  const Index end = top_half_edge(entry);
  if (end == kNone) refuse(arc, "it ends in a cap, and caps stay");
  const Index other_end = top_half_edge(other);
  if (other_end != kNone && TriangleMesh::triangle_of(other_end) == TriangleMesh::triangle_of(end))
    refuse(arc, "its other side of this kind ends in the same maximum");
  for (Index h = entry;;) {
    const Index t = TriangleMesh::triangle_of(h);
    const Index exit = paired_halfedge(t);
    side_[t] = static_cast<std::uint8_t>(h % 3);
    if (exit == kNone) return;
    h = mesh_.twin(exit);
  }
}

}  // namespace morsel::mscomplex
