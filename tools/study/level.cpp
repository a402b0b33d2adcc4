#include "morsel/tools/study/level.h"

#include <algorithm>
#include <numeric>

namespace morsel::tools {

using core::Index;

std::string key_of(SegmentKind kind) {
  std::string key = to_string(kind);
  std::ranges::replace(key, '-', '_');
  return key;
}

std::string_view to_string(PointStatus status) {
  constexpr std::array<std::string_view, 4> kNames = {"first", "kept", "moved", "new"};
  return kNames[static_cast<std::size_t>(status)];
}

const mscomplex::SegmentLabels& Level::cells(SegmentKind kind) const {
  switch (kind) {
    case SegmentKind::descending:
      return segmentation.descending;
    case SegmentKind::ascending:
      return segmentation.ascending;
    case SegmentKind::morse_smale:
      break;
  }
  return segmentation.morse_smale;
}

Index Level::label_count(SegmentKind kind) const {
  switch (kind) {
    case SegmentKind::descending:
      return complex.maximum_count() + complex.cap_count();
    case SegmentKind::ascending:
      return complex.minimum_count();
    case SegmentKind::morse_smale:
      break;
  }
  return segmentation.morse_smale.count;
}

std::vector<Index> Level::labels(SegmentKind kind) const {
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
