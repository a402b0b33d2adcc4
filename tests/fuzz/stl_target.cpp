#include <algorithm>
#include <array>
#include <vector>

#include "mesh_checks.h"
#include "morsel/core/error.h"
#include "target.h"

namespace {

using namespace morsel;

/// Equal positions are one vertex, and vertices are numbered as they first appear.
void check_welding(const core::PolygonSoup& soup) {
  std::vector<std::array<double, 3>> places;
  for (const core::Point& p : soup.positions)
    if (!p.hasNaN()) places.push_back({p.x(), p.y(), p.z()});
  std::sort(places.begin(), places.end());
  fuzz::require(std::adjacent_find(places.begin(), places.end()) == places.end(), "two vertices in a place");
  core::Index next = 0;
  for (const core::Index v : soup.corners) {
    fuzz::require(v <= next, "order of the vertices");
    if (v == next) ++next;
  }
  fuzz::require(next == soup.positions.size(), "a vertex of no triangle");
}

}  // namespace

void morsel::fuzz::stl(std::string_view bytes) {
  check_mesh_format(bytes, core::MeshFormat::stl);
  try {
    check_welding(core::parse_polygon_soup(bytes, core::MeshFormat::stl, "fuzz").soup);
  } catch (const core::BadInput&) {
  }
}
