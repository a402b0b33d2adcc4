#include "morsel/mscomplex/hierarchy_cursor.h"

#include <string>

#include "morsel/core/error.h"
#include "morsel/core/require.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

namespace {

/// The arc of the same kind at the other side of its saddle.
Index opposite(Index arc) { return arc % 4 < 2 ? arc + 2 : arc - 2; }
/// One of the two arcs of the other kind; opposite() gives the second one.
Index crossing(Index arc) { return arc % 2 == 0 ? arc + 1 : arc - 1; }

}  // namespace

HierarchyCursor::HierarchyCursor(const PersistenceHierarchy& hierarchy)
    : hierarchy_(&hierarchy),
      next_(complex().arc_count()),
      previous_(complex().arc_count()),
      first_(complex().node_count(), kNone) {
  for (Index arc = 0; arc < complex().arc_count(); ++arc) {
    next_[arc] = complex().next_around_end(arc);
    previous_[arc] = complex().previous_around_end(arc);
  }
  for (Index node = 0; node < complex().node_count(); ++node)
    if (const auto arcs = complex().arcs_ending_at(node); !arcs.empty()) first_[node] = arcs.front();
}

void HierarchyCursor::go_to(Index level) {
  if (level > hierarchy_->levels())
    throw core::InvalidArgument("the hierarchy has levels 0 to " + std::to_string(hierarchy_->levels()) +
                                ", not " + std::to_string(level));
  const auto all = hierarchy_->cancellations();
  while (level_ < level) cancel(all[level_]);
  while (level_ > level) restore(all[level_ - 1]);
}

void HierarchyCursor::take_out(Index arc) {
  const Index node = arc_end(arc);
  if (first_[node] == arc) first_[node] = next_[arc] == arc ? kNone : next_[arc];
  next_[previous_[arc]] = next_[arc];
  previous_[next_[arc]] = previous_[arc];
}

/// Undoes take_out(), the last one first ("dancing links": an arc that is out remembers its neighbours).
void HierarchyCursor::put_back(Index arc) {
  const Index node = arc_end(arc);
  if (first_[node] == kNone) first_[node] = arc;
  next_[previous_[arc]] = arc;
  previous_[next_[arc]] = arc;
}

/// The two arcs contract to one point: in the order around the survivor, the arc that leads to the saddle is
/// replaced by the arcs around the extremum, from the one after its own arc to the one before it.
void HierarchyCursor::cancel(const Cancellation& c) {
  const Index in = opposite(c.arc);  // at the survivor
  take_out(crossing(c.arc));
  take_out(opposite(crossing(c.arc)));
  const Index after = next_[c.arc];
  const bool alone = after == c.arc;
  if (first_[c.survivor] == in) first_[c.survivor] = !alone ? after : next_[in] != in ? next_[in] : kNone;
  if (alone) {
    next_[previous_[in]] = next_[in];
    previous_[next_[in]] = previous_[in];
  } else {
    const Index before = previous_[c.arc];
    const bool was_alone = next_[in] == in;
    const Index left = was_alone ? before : previous_[in];
    const Index right = was_alone ? after : next_[in];
    next_[left] = after;
    previous_[after] = left;
    next_[before] = right;
    previous_[right] = before;
  }
  ++level_;
}

void HierarchyCursor::restore(const Cancellation& c) {
  --level_;
  const Index in = opposite(c.arc);
  for (const Index arc : {in, c.arc}) {
    next_[previous_[arc]] = arc;
    previous_[next_[arc]] = arc;
  }
  first_[c.survivor] = in;
  first_[c.extremum] = c.arc;
  put_back(opposite(crossing(c.arc)));
  put_back(crossing(c.arc));
}

/// By the same walk as MorseSmaleComplex::quad().
Quad HierarchyCursor::quad_left_of(Index descending_arc) const {
  const Index down = descending_arc;
  const Index up = down + 1;
  const Index other_down = previous_around_end(down);
  const Index other_up = complex().previous_around_saddle(other_down);
  return {{arc_end(down), complex().arc_saddle(other_down), arc_end(up), complex().arc_saddle(down)},
          {other_down, other_up, up, down}};
}

void HierarchyCursor::validate() const {
  constexpr core::Require require("HierarchyCursor::validate");
  const MorseSmaleComplex& all = complex();
  const auto component = [&](Index node) { return all.mesh().component_of_vertex(all.node(node).vertex); };
  std::vector<long> euler(all.mesh().component_count(), 0);
  std::vector<Index> around(all.arc_count(), kNone);
  for (Index node = 0; node < all.node_count(); ++node) {
    if (!is_alive(node)) continue;
    ++euler[component(node)];
    if (all.kind(node) == NodeKind::saddle) continue;
    for_each_arc_around(node, [&](Index arc) {
      require(is_arc_alive(arc) && arc_end(arc) == node, "an arc of another node around a node, arc", arc);
      require(around[arc] == kNone, "met twice, arc", arc);
      require(previous_[next_[arc]] == arc && next_[previous_[arc]] == arc, "next or previous of arc", arc);
      around[arc] = node;
    });
  }
  std::vector<Index> sides(all.arc_count(), 0);
  for (Index arc = 0; arc < all.arc_count(); ++arc) {
    if (!is_arc_alive(arc)) continue;
    require(around[arc] != kNone, "around no node, arc", arc);
    --euler[component(all.arc_saddle(arc))];
    if (MorseSmaleComplex::arc_kind(arc) == ArcKind::ascending) continue;
    const Quad quad = quad_left_of(arc);
    require(quad.nodes[0] == arc_end(quad.arcs[0]) && quad.nodes[2] == arc_end(quad.arcs[1]) &&
                previous_around_end(quad.arcs[1]) == quad.arcs[2],
            "the walk does not close around the quad left of arc", arc);
    for (const Index side : quad.arcs) ++sides[side];
    ++euler[component(quad.nodes[0])];
  }
  for (Index arc = 0; arc < all.arc_count(); ++arc)
    require(sides[arc] == (is_arc_alive(arc) ? 2u : 0u), "not between two quads: arc", arc);
  for (Index c = 0; c < all.mesh().component_count(); ++c)
    require(euler[c] == all.mesh().euler_characteristic(c) + long{all.mesh().boundary_loop_count(c)},
            "Euler's identity in component", c);
}

}  // namespace morsel::mscomplex
