#pragma once
/// The persistence diagram of a scalar field: extremum-saddle pairs and essential classes.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::persistence {

using core::Index;

/// What a saddle is paired with.
enum class PairKind : std::uint8_t {
  minimum_saddle,  ///< a minimum whose component meets an older one at the saddle
  saddle_maximum,  ///< the same, seen from above
  saddle_cap       ///< a virtual maximum at +∞; its persistence is infinite
};

/// "minimum-saddle", "saddle-maximum", "saddle-cap".
std::string_view to_string(PairKind kind);

struct PersistencePair {
  Index extremum = core::kNone;  ///< the minimum's or maximum's vertex, or the cap's boundary loop
  Index saddle = core::kNone;    ///< a vertex; one of multiplicity m is in up to m pairs
  PairKind kind = PairKind::minimum_saddle;
  double birth = 0;  ///< the lower of the two values
  double death = 0;  ///< the higher one; +∞ for a cap
  /// The absolute difference of the two values, in the field's unit.
  double persistence() const { return death - birth; }
  friend bool operator==(const PersistencePair&, const PersistencePair&) = default;
};

/// The essential extrema of a component of the mesh.
struct EssentialExtrema {
  Index minimum = core::kNone;  ///< its lowest vertex
  Index top = core::kNone;      ///< its highest vertex if it is closed, its last boundary loop otherwise
  bool top_is_cap = false;
  friend bool operator==(const EssentialExtrema&, const EssentialExtrema&) = default;
};

/// A saddle that is paired with no extremum, as often as `count` says.
struct EssentialSaddle {
  Index vertex = core::kNone;
  Index count = 0;
  friend bool operator==(const EssentialSaddle&, const EssentialSaddle&) = default;
};

/// Pairs and essential classes of a field on the capped surface. Component by component: pairs + essential
/// saddles (with their counts) = saddle multiplicity, and the essential saddles number 2 × genus.
struct Diagram {
  /// By ascending persistence: first the finite pairs, then those of caps. Among equals minimum_saddle comes
  /// before saddle_maximum, then the saddle that its union-find sweep (from below, from above) meets first,
  /// then, at one saddle, the younger extremum. Cancellation takes pairs in this order.
  std::vector<PersistencePair> pairs;
  std::size_t finite_count = 0;
  std::vector<EssentialExtrema> essential_extrema;  ///< per component of the mesh
  std::vector<EssentialSaddle> essential_saddles;   ///< by ascending vertex

  std::span<const PersistencePair> finite_pairs() const {
    return std::span<const PersistencePair>(pairs).first(finite_count);
  }
  std::span<const PersistencePair> cap_pairs() const {
    return std::span<const PersistencePair>(pairs).subspan(finite_count);
  }
  /// How many finite pairs have a persistence above `threshold`. O(log n).
  std::size_t count_above(double threshold) const;
  /// The largest finite persistence; 0 if there is no pair.
  double largest() const { return finite_count == 0 ? 0 : pairs[finite_count - 1].persistence(); }
};

/// Persistence of an essential class or a cap.
inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Persistence of every critical vertex: an extremum's is that of its pair, a multiple saddle's the largest
/// of its pairs, kInfinite if it is essential or paired with a cap; 0 at regular vertices. O(n).
std::vector<double> vertex_persistence(const Diagram& diagram, Index vertex_count);

/// The extrema by falling persistence: first the essential ones, by component, its minimum before its
/// maximum, then those of the pairs from the last to the first; `count` of them, or all that there are. Caps
/// are left out. O(n).
std::vector<Index> persistent_extrema(const Diagram& diagram, std::size_t count);

}  // namespace morsel::persistence
