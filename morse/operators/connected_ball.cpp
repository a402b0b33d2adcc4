#include "morsel/morse/operators/connected_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/largest_square.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {

using core::Index;
using core::Point;

ConnectedBalls::ConnectedBalls(const core::TriangleMesh& mesh) {
  const UnitSized unit = unit_sized(mesh);
  positions_.assign(unit.mesh.positions().begin(), unit.mesh.positions().end());
  exponent_ = unit.exponent;
  start_.assign(positions_.size() + 1, 0);
  for (Index e = 0; e < mesh.edge_count(); ++e)
    for (const Index v : mesh.edge_vertices(e)) ++start_[v + 1];
  for (std::size_t v = 0; v < positions_.size(); ++v) start_[v + 1] += start_[v];
  neighbors_.resize(start_.back());
  core::parallel_for_each(positions_.size(), [&](std::size_t v) {
    std::size_t at = start_[v];
    core::for_each_neighbor(mesh, static_cast<Index>(v), [&](Index u) { neighbors_[at++] = u; });
  });
}

std::size_t ConnectedBalls::grain() const {
  // A Walk is an array over all vertices that begins as zeros: no more than 128 of them.
  return std::max<std::size_t>(256, positions_.size() / 128);
}

ConnectedBalls::Walk::Walk(const ConnectedBalls& balls) : balls_(balls), seen_(balls.positions_.size(), 0) {}

void ConnectedBalls::Walk::within(Index v, double radius, std::vector<Index>& found) {
  begin(v, radius, std::numeric_limits<std::size_t>::max(), found);
}

void ConnectedBalls::Walk::begin(Index v, double radius, std::size_t most, std::vector<Index>& found) {
  const double square = largest_square(std::ldexp(radius, -balls_.exponent_));
  const Point& center = balls_.positions_[v];
  ++search_;
  seen_[v] = search_;
  found.assign(1, v);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const Index u : balls_.neighbors(found[i])) {
      if (seen_[u] == search_ || !((balls_.positions_[u] - center).squaredNorm() <= square)) continue;
      seen_[u] = search_;
      found.push_back(u);
      if (found.size() > most) return;
    }
}

void ConnectedBalls::Walk::widen(std::size_t least, std::vector<Index>& found) {
  for (std::size_t first = 0; found.size() < least && first < found.size();) {
    const std::size_t last = found.size();
    for (; first < last; ++first)
      for (const Index u : balls_.neighbors(found[first])) {
        if (seen_[u] == search_) continue;
        seen_[u] = search_;
        found.push_back(u);
      }
  }
}

}  // namespace morsel::morse
