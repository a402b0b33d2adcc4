#include "morsel/tools/plot/shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace morsel::tools::plot {
namespace {

constexpr double kUnseen = 0.2;

bool inside(Spot spot, const Box& box) {
  constexpr double kRounding = 1e-6;
  return spot.x >= box.x - kRounding && spot.x <= box.right() + kRounding && spot.y >= box.y - kRounding &&
         spot.y <= box.bottom() + kRounding;
}

/// The part of a segment in the box.
std::optional<std::pair<Spot, Spot>> clipped(Spot a, Spot b, const Box& box) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double direction[] = {-dx, dx, -dy, dy};
  const double distance[] = {a.x - box.x, box.right() - a.x, a.y - box.y, box.bottom() - a.y};
  double first = 0, last = 1;
  for (int i = 0; i < 4; ++i) {
    if (direction[i] == 0) {
      if (distance[i] < 0) return std::nullopt;
    } else if (direction[i] < 0) {
      first = std::max(first, distance[i] / direction[i]);
    } else {
      last = std::min(last, distance[i] / direction[i]);
    }
  }
  if (first > last) return std::nullopt;
  const auto at = [&](double t) { return t == 0 ? a : t == 1 ? b : Spot{a.x + t * dx, a.y + t * dy}; };
  return std::pair{at(first), at(last)};
}

bool same(Spot a, Spot b, double distance) {
  return std::abs(a.x - b.x) <= distance && std::abs(a.y - b.y) <= distance;
}

/// Without points near the one before; the last one stays where it is.
std::vector<Spot> reduced(const std::vector<Spot>& line) {
  std::vector<Spot> result;
  for (const Spot& spot : line)
    if (result.empty() || !same(spot, result.back(), kUnseen)) result.push_back(spot);
  if (result.size() > 1 && !same(result.back(), line.back(), 0)) {
    result.back() = line.back();
  } else if (result.size() == 1 && line.size() > 1) {
    result.push_back(line.back());
  }
  return result;
}

/// One spot a cell of a grid over the box, the first.
std::vector<Spot> one_per_cell(const std::vector<Spot>& spots, const Box& box, double cell) {
  const auto columns = static_cast<std::size_t>(box.width / cell) + 2;
  const auto rows = static_cast<std::size_t>(box.height / cell) + 2;
  std::vector<bool> taken(columns * rows, false);
  std::vector<Spot> result;
  for (const Spot& spot : spots) {
    const auto place = [cell](double distance) {
      return static_cast<std::size_t>(std::max(0., std::floor(distance / cell)));
    };
    const std::size_t i = place(spot.y - box.y) * columns + place(spot.x - box.x);
    if (taken[i]) continue;
    taken[i] = true;
    result.push_back(spot);
  }
  return result;
}

}  // namespace

std::vector<std::vector<Spot>> visible_line(const std::vector<Spot>& spots, const Box& box) {
  std::vector<std::vector<Spot>> parts;
  for (std::size_t i = 0; i + 1 < spots.size(); ++i) {
    const auto segment = clipped(spots[i], spots[i + 1], box);
    if (!segment) continue;
    if (parts.empty() || !same(parts.back().back(), segment->first, 0)) parts.push_back({segment->first});
    parts.back().push_back(segment->second);
  }
  for (std::vector<Spot>& part : parts) part = reduced(part);
  return parts;
}

Marks visible_marks(const std::vector<Spot>& spots, const Box& box, std::size_t limit) {
  Marks marks;
  for (const Spot& spot : spots)
    if (inside(spot, box)) marks.spots.push_back(spot);
  if (marks.spots.size() <= limit) return marks;
  const std::vector<Spot> all = std::move(marks.spots);
  for (marks.cell = kUnseen;; marks.cell *= 1.25) {
    marks.spots = one_per_cell(all, box, marks.cell);
    if (marks.spots.size() <= limit) return marks;
  }
}

}  // namespace morsel::tools::plot
