#pragma once
/// The hierarchy of Morse-Smale complexes that results from cancelling one by persistence.

#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/mscomplex/merge_history.h"

namespace morsel::mscomplex {

/// One cancellation: a saddle and an adjacent extremum are removed, with the saddle's four arcs; the arcs
/// that ended in the extremum are extended along the saddle's other arc of that kind to the extremum there.
struct Cancellation {
  core::Index arc = core::kNone;  ///< of the saddle, the one that ended in the extremum: 4 × saddle + side
  core::Index extremum = core::kNone;  ///< node: a minimum or a maximum, never a cap
  core::Index survivor = core::kNone;  ///< node: the minimum, maximum or cap that takes over its arcs
  double persistence = 0;              ///< |f(saddle) − f(extremum)|
};

/// All complexes between that of a field and the one with nothing left to cancel (Edelsbrunner, Harer,
/// Zomorodian 2003, "Hierarchical Morse-Smale complexes for piecewise linear 2-manifolds"; Bremer,
/// Edelsbrunner, Hamann, Pascucci 2004). A level is the number of cancellations done: level 0 is the
/// complex itself, level levels() has only what is essential or paired with caps.
///
/// Cancellations come by ascending persistence; among equals those of minima before those of maxima, then
/// the saddle that the union-find sweep (up for minima, down for maxima) meets first, then, at one saddle
/// vertex, the younger extremum: the order of persistence::Diagram, whose finite pairs they are. Each is
/// legal when its turn comes: exactly one of its saddle's two arcs of that kind ends in the extremum.
///
/// Nodes keep the numbers and values that they have in the complex, and arcs theirs: arc 4i + k is side k of
/// saddle i at every level. Cancelling in the field (persistence::cancel()) instead moves saddles that lie in
/// a flooded basin up to where it overflows; here they keep their value, so that an extended arc may lead
/// uphill first.
///
/// Immutable; safe to read from any number of threads. O(n) and O(s log s) in the number of saddles. Memory:
/// some 60 bytes a saddle besides the complex.
class PersistenceHierarchy {
 public:
  /// `complex` must be the field's own, from its lower stars (throws InvalidArgument if it is on another
  /// mesh).
  PersistenceHierarchy(const core::ScalarField& field, MorseSmaleComplex complex,
                       const core::Progress& progress = {});
  explicit PersistenceHierarchy(const core::ScalarField& field, const core::Progress& progress = {})
      : PersistenceHierarchy(field, MorseSmaleComplex(field, progress), progress) {}

  /// Level 0.
  const MorseSmaleComplex& complex() const { return complex_; }
  /// In order; cancellation i leads from level i to level i + 1.
  std::span<const Cancellation> cancellations() const { return cancellations_; }
  core::Index levels() const { return static_cast<core::Index>(cancellations_.size()); }
  /// The saddle node of a cancellation.
  core::Index saddle_of(const Cancellation& c) const { return complex_.arc_saddle(c.arc); }

  /// The level at which all pairs of at most this persistence are cancelled, and no others. O(log s).
  core::Index level_above(double threshold) const;
  /// The first level with at most `count` critical cells (minima, saddles with their multiplicities, maxima),
  /// or the last one if none has so few: each cancellation removes two of them. O(1).
  core::Index level_with(std::size_t count) const;
  /// The first level with at most `count` minima (maxima without caps), or the last one. O(log s).
  core::Index level_with_minima(core::Index count) const;
  core::Index level_with_maxima(core::Index count) const;

  // Queries at any level.
  core::Index minimum_count(core::Index level) const {
    return complex_.minimum_count() - cancelled_minima_[level];
  }
  core::Index saddle_count(core::Index level) const { return complex_.saddle_count() - level; }
  core::Index maximum_count(core::Index level) const {
    return complex_.maximum_count() - (level - cancelled_minima_[level]);
  }
  /// The level from which on a node is cancelled; kNone if it never is. O(1).
  core::Index last_level(core::Index node) const { return gone_[node]; }
  bool is_alive(core::Index node, core::Index level) const { return level < gone_[node]; }
  /// The minimum, maximum or cap that the node of one has become. O(log s).
  core::Index survivor(core::Index extremum_node, core::Index level) const {
    return node_of(history_.representative(extremum_of(extremum_node), level));
  }
  /// Where an arc of a saddle that is alive at that level ends. O(log s).
  core::Index arc_end(core::Index arc, core::Index level) const {
    return survivor(complex_.arc_end(arc), level);
  }

  /// The discrete gradient with the V-paths between cancelled cells reversed (Forman 1998), whose critical
  /// cells are those alive. So MorseSmaleComplex(field, gradient(level)) is the complex of that
  /// level with the geometry of its arcs (its nodes and arcs are renumbered, in the same order), and
  /// segment(field, gradient(level)) its segmentation. O(n) and the lengths of the V-paths.
  DiscreteGradient gradient(core::Index level) const;

  /// Checks every cancellation against plain relabelling of all arcs, for tests: O(s²). Throws
  /// std::logic_error.
  void validate() const;

 private:
  core::Index extremum_of(core::Index node) const {
    return node < complex_.minimum_count() ? node : node - complex_.saddle_count();
  }
  core::Index node_of(core::Index extremum) const {
    return extremum < complex_.minimum_count() ? extremum : extremum + complex_.saddle_count();
  }
  template <class Holds>
  core::Index first_level_where(const Holds& holds) const;
  void pair_up(const core::ScalarField& field);
  void cancel_all();

  MorseSmaleComplex complex_;
  std::vector<Cancellation> cancellations_;
  std::vector<core::Index>
      cancelled_minima_;           // per level: how many of the cancellations so far were of minima
  std::vector<core::Index> gone_;  // per node
  MergeHistory history_;           // of extrema: minima, maxima, caps
};

}  // namespace morsel::mscomplex
