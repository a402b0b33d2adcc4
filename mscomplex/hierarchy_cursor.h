#pragma once
/// A cursor on a hierarchy of complexes, for moving up and down its levels.

#include <vector>

#include "morsel/mscomplex/hierarchy.h"

namespace morsel::mscomplex {

/// The combinatorial complex of one level: arcs, their cyclic order around each node, cells (Quad); kept
/// up to date while it moves from level to level. Each cancellation that is done or undone costs O(log s);
/// nothing else is touched. Nodes and arcs keep the numbers that they have in the hierarchy's complex.
/// Queries must be for nodes and arcs that are alive at the level.
///
/// A value type; copies are independent. Refers to the hierarchy, which must outlive it. Memory: 12 bytes an
/// arc.
class HierarchyCursor {
 public:
  /// At level 0. O(s).
  explicit HierarchyCursor(const PersistenceHierarchy& hierarchy);

  core::Index level() const { return level_; }
  /// Throws InvalidArgument if the hierarchy has no such level. O(|difference| · log s).
  void go_to(core::Index level);

  bool is_alive(core::Index node) const { return hierarchy_->is_alive(node, level_); }
  bool is_arc_alive(core::Index arc) const { return is_alive(complex().arc_saddle(arc)); }
  /// The node where an arc ends now. O(log s).
  core::Index arc_end(core::Index arc) const { return hierarchy_->arc_end(arc, level_); }

  // The cyclic order is counter-clockwise, seen from outside, as that of the complex. Around a saddle it
  // never changes.
  core::Index next_around_end(core::Index arc) const { return next_[arc]; }
  core::Index previous_around_end(core::Index arc) const { return previous_[arc]; }
  /// One of the arcs that end in an extremum or cap; kNone if none does.
  core::Index arc_ending_at(core::Index node) const { return first_[node]; }
  /// Calls visit(arc) for each arc at a node, counter-clockwise.
  template <class Visit>
  void for_each_arc_around(core::Index node, Visit&& visit) const {
    if (complex().kind(node) == NodeKind::saddle) {
      complex().for_each_arc_around(node, visit);
      return;
    }
    const core::Index first = first_[node];
    if (first == core::kNone) return;
    core::Index arc = first;
    do {
      visit(arc);
      arc = next_[arc];
    } while (arc != first);
  }

  /// The cell on the left of a descending arc, seen from its saddle.
  Quad quad_left_of(core::Index descending_arc) const;

  /// Checks the orders against each other and the complex's Euler identity component by component, for tests.
  /// Throws std::logic_error. O(s log s).
  void validate() const;

 private:
  const MorseSmaleComplex& complex() const { return hierarchy_->complex(); }
  void cancel(const Cancellation& c);
  void restore(const Cancellation& c);
  void take_out(core::Index arc);
  void put_back(core::Index arc);

  const PersistenceHierarchy* hierarchy_;
  core::Index level_ = 0;
  std::vector<core::Index> next_;      // per arc, around its end; those of a dead arc are as when it died
  std::vector<core::Index> previous_;  // per arc
  std::vector<core::Index> first_;     // per node
};

}  // namespace morsel::mscomplex
