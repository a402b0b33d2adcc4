#include "morsel/tools/study/level.h"

#include <numeric>

namespace morsel::tools {

using core::Index;

std::string_view to_string(CellKind kind) {
  constexpr std::array<std::string_view, kCellKinds.size()> kNames = {"descending", "ascending",
                                                                      "morse_smale"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view to_string(PointStatus status) {
  constexpr std::array<std::string_view, 4> kNames = {"first", "kept", "moved", "new"};
  return kNames[static_cast<std::size_t>(status)];
}

const mscomplex::SegmentLabels& Level::cells(CellKind kind) const {
  switch (kind) {
    case CellKind::descending:
      return segmentation.descending;
    case CellKind::ascending:
      return segmentation.ascending;
    case CellKind::morse_smale:
      break;
  }
  return segmentation.morse_smale;
}

Index Level::label_count(CellKind kind) const {
  switch (kind) {
    case CellKind::descending:
      return complex.maximum_count() + complex.cap_count();
    case CellKind::ascending:
      return complex.minimum_count();
    case CellKind::morse_smale:
      break;
  }
  return segmentation.morse_smale.count;
}

std::vector<Index> Level::labels(CellKind kind) const {
  const mscomplex::SegmentLabels& labels = cells(kind);
  std::vector<Index> carried(label_count(kind));
  std::iota(carried.begin(), carried.end(), Index{0});
  if (labels.count == carried.size()) return carried;
  std::vector<std::uint8_t> occurs(carried.size(), 0);
  for (const Index label : labels.triangle) occurs[label] = 1;
  std::erase_if(carried, [&](Index label) { return occurs[label] == 0; });
  return carried;
}

PointStatus Level::status(std::size_t point) const {
  if (place == 0) return PointStatus::first;
  const Index parent = parents[point];
  if (parent == core::kNone) return PointStatus::fresh;
  return parent == points.points[point].vertex ? PointStatus::kept : PointStatus::moved;
}

std::size_t Level::count(PointStatus wanted) const {
  std::size_t found = 0;
  for (std::size_t i = 0; i < parents.size(); ++i) found += status(i) == wanted ? 1 : 0;
  return found;
}

}  // namespace morsel::tools
