#include "morsel/tools/study/segment_atoms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "morsel/core/error.h"
#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/numbers.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::Point;

constexpr double kFarthest = 5;  // Å from a sphere

}  // namespace

NearestAtoms nearest_atoms(const core::TriangleMesh& mesh, std::span<const core::Atom> atoms,
                           const core::Progress& progress) {
  if (atoms.empty()) throw core::InvalidArgument("the nearest atoms need at least one atom");
  std::vector<Point> centers;
  centers.reserve(atoms.size());
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const core::Atom& atom : atoms) {
    if (!atom.position.allFinite() || !(atom.radius > 0) || !std::isfinite(atom.radius))
      throw core::InvalidArgument(atom.described() + " has no finite position and positive radius");
    centers.push_back(atom.position);
    smallest = std::min(smallest, atom.radius);
    largest = std::max(largest, atom.radius);
  }
  const core::PointSearch search(centers);

  NearestAtoms nearest;
  nearest.of_vertex.assign(mesh.vertex_count(), core::kNone);
  constexpr std::size_t kRound = 1 << 16;
  constexpr std::size_t kVertices = 256;
  const auto find = [&](const Point& x, std::vector<Index>& near) {
    // The sphere of the nearest center is at most so far, any nearer one has its center within the reach.
    const double first = search.reach(x, 1);
    if (!(first <= kFarthest + largest)) return core::kNone;
    search.within(x, (first - smallest + largest) * (1 + 1e-12), near);
    Index best = core::kNone;
    double least = std::numeric_limits<double>::infinity();
    for (const Index i : near) {
      const double distance = (x - centers[i]).norm() - atoms[i].radius;
      if (distance < least) {
        least = distance;
        best = i;
      }
    }
    return least <= kFarthest ? best : core::kNone;
  };
  for (std::size_t begin = 0; begin < nearest.of_vertex.size(); begin += kRound) {
    progress.update("finding the nearest atoms",
                    static_cast<double>(begin) / static_cast<double>(nearest.of_vertex.size()));
    core::parallel_for(begin, std::min(begin + kRound, nearest.of_vertex.size()), kVertices,
                       [&](std::size_t from, std::size_t to) {
                         std::vector<Index> near;
                         for (std::size_t v = from; v < to; ++v)
                           nearest.of_vertex[v] = find(mesh.position(static_cast<Index>(v)), near);
                       });
  }
  nearest.without =
      static_cast<std::size_t>(std::count(nearest.of_vertex.begin(), nearest.of_vertex.end(), core::kNone));
  if (nearest.without == nearest.of_vertex.size())
    throw core::BadInput("no vertex of the mesh lies within " + core::shortest(kFarthest) +
                         " Å of one of the " + std::to_string(atoms.size()) +
                         " atoms: the mesh must be a surface of the molecule, in its place and in Å");
  return nearest;
}

std::vector<SegmentAtom> atoms_of_segments(const core::TriangleMesh& mesh, std::span<const Index> labels,
                                           const NearestAtoms& nearest) {
  if (labels.size() != mesh.triangle_count() || nearest.of_vertex.size() != mesh.vertex_count())
    throw core::InvalidArgument("segments and nearest atoms must be those of the mesh");
  std::vector<SegmentAtom> corners;
  corners.reserve(3 * labels.size());
  for (std::size_t t = 0; t < labels.size(); ++t) {
    const core::Triangle& corner = mesh.triangles()[t];
    const Point& a = mesh.position(corner[0]);
    const double third = (mesh.position(corner[1]) - a).cross(mesh.position(corner[2]) - a).norm() / 2 / 3;
    for (const Index v : corner)
      if (nearest.of_vertex[v] != core::kNone) corners.push_back({labels[t], nearest.of_vertex[v], third});
  }
  std::stable_sort(corners.begin(), corners.end(), [](const SegmentAtom& a, const SegmentAtom& b) {
    return a.segment != b.segment ? a.segment < b.segment : a.atom < b.atom;
  });
  std::vector<SegmentAtom> atoms;
  for (const SegmentAtom& corner : corners) {
    if (atoms.empty() || atoms.back().segment != corner.segment || atoms.back().atom != corner.atom)
      atoms.push_back({corner.segment, corner.atom, 0});
    atoms.back().area += corner.area;
  }
  return atoms;
}

}  // namespace morsel::tools
