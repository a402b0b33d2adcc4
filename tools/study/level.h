#pragma once
/// A level of a hierarchy: a field's critical points, complex and cells, and their links to the levels beside
/// it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/morse/critical_points.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/mscomplex/overlap.h"
#include "morsel/mscomplex/segmentation.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// The cancellations that lead to a level by persistence.
struct CancelledLevel {
  core::Index cancellations = 0;
  double largest = 0;                     ///< the largest persistence among them
  std::optional<double> threshold = {};   ///< the one requested, in the field's unit
  std::optional<std::size_t> count = {};  ///< the number of critical cells requested
};

/// The definition of a level.
struct LevelName {
  std::string asked;  ///< "5", "0.1%", "150"
  std::optional<int> iteration = {};
  std::optional<CancelledLevel> cancelled = {};
  std::string note = {};  ///< why it differs from the request; empty if it does not
};

using mscomplex::SegmentKind;

/// The name of a kind of segments as a key of documents: "morse_smale", not "morse-smale".
std::string key_of(SegmentKind kind);

/// The cells of one kind, by label, with the cells of the level before (finer) and after (coarser) that they
/// share the largest area with; of equally large ones that of smallest label. kNone where there is no such
/// level, and for the cell of a cap that no triangle belongs to.
struct CellLinks {
  std::vector<double> areas;
  std::vector<mscomplex::Overlap> parents;
  std::vector<mscomplex::Overlap> merges_into;
};

/// How a critical point of a level relates to the level before.
enum class PointStatus : std::uint8_t {
  first,  ///< of the finest level: it has no level before
  kept,   ///< its parent is at the same vertex
  moved,  ///< its parent is at another vertex
  fresh   ///< it has no parent: it is new
};
/// "first", "kept", "moved", "new".
std::string_view to_string(PointStatus status);

struct Level {
  std::size_t place = 0;  ///< 0 is the finest
  LevelName name;
  std::shared_ptr<const core::ScalarField> field;
  morse::CriticalPoints points;      ///< the nodes of the complex but for caps, by vertex
  std::vector<double> persistence;   ///< per point; kInfinite if essential or paired with a cap
  std::vector<core::Index> parents;  ///< per point, the vertex of a point of the level before; kNone
  mscomplex::MorseSmaleComplex complex;
  mscomplex::Segmentation segmentation;
  core::Index quad_cells = 0;  ///< quads of the complex that have area
  std::array<CellLinks, mscomplex::kSegmentKinds.size()> links;
  Timings timings;

  const mscomplex::SegmentLabels& cells(SegmentKind kind) const;
  const CellLinks& cell_links(SegmentKind kind) const { return links[static_cast<std::size_t>(kind)]; }
  /// Labels are below this number, which counts also those that no triangle carries; cells().count does not.
  core::Index label_count(SegmentKind kind) const;
  /// The labels that triangles carry, ascending; as many as cells().count. O(n).
  std::vector<core::Index> labels(SegmentKind kind) const;

  PointStatus status(std::size_t point) const;
  std::size_t count(PointStatus status) const;
};

}  // namespace morsel::tools
