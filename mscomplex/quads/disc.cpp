#include "morsel/mscomplex/quads/disc.h"

#include <stdexcept>

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

void DiscFinder::flood(Index t, std::vector<Index>& triangles) {
  place_.resize(mesh_.triangle_count(), kNone);
  triangles.assign(1, t);
  place_[t] = 0;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    for (Index h = 3 * triangles[k]; h < 3 * triangles[k] + 3; ++h) {
      if (!mesh_.is_free(h)) continue;
      const Index across = mesh_.twin(h) / 3;
      if (place_[across] != kNone) continue;
      place_[across] = static_cast<Index>(triangles.size());
      triangles.push_back(across);
    }
}

Index DiscFinder::find_border(Index t) {
  std::vector<Index> triangles;
  flood(t, triangles);
  Index found = kNone;
  for (const Index u : triangles) {
    place_[u] = kNone;
    for (Index h = 3 * u; h < 3 * u + 3 && found == kNone; ++h)
      if (!mesh_.is_free(h)) found = h;
  }
  return found;
}

Disc DiscFinder::find(Index start, const std::string& what) {
  Disc disc;
  flood(start / 3, disc.triangles);
  disc.corner.assign(3 * disc.triangles.size(), kNone);
  const auto corner_of = [&](Index h) -> Index& {
    return disc.corner[3 * std::size_t{place_[h / 3]} + h % 3];
  };
  // Assigns the corners from that of h on, counter-clockwise up to a labelled edge or all around, to disc
  // vertex `name`.
  const auto name_corners = [&](Index h, Index name) {
    disc.vertex.push_back(mesh_.origin(h));
    Index g = h;
    do {
      corner_of(g) = name;
      g = LayoutMesh::previous(g);
      if (!mesh_.is_free(g)) break;
      g = mesh_.twin(g);
    } while (g != h);
  };

  Index h = start;
  do {
    name_corners(h, static_cast<Index>(disc.border.size()));
    disc.border.push_back(h);
    h = LayoutMesh::next(h);
    while (mesh_.is_free(h)) h = LayoutMesh::next(mesh_.twin(h));
  } while (h != start);

  Index labelled = 0;
  for (const Index t : disc.triangles)
    for (Index g = 3 * t; g < 3 * t + 3; ++g) {
      if (!mesh_.is_free(g)) ++labelled;
      if (corner_of(g) == kNone) name_corners(g, disc.vertex_count());
    }
  const auto faces = static_cast<long>(disc.triangles.size());
  const long edges = (3 * faces + labelled) / 2;
  for (const Index t : disc.triangles) place_[t] = kNone;
  if (labelled != disc.border_size() || long{disc.vertex_count()} - edges + faces != 1)
    throw std::logic_error("quad layout: the region of " + what + " is not a disc");
  return disc;
}

}  // namespace morsel::mscomplex
