// The only file with OpenVDB's headers, which take long to compile.
#include "morsel/tools/molecule/grid_mesh.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::Point;
using Leaf = openvdb::FloatTree::LeafNodeType;
/// Grid points along a side of OpenVDB's blocks.
constexpr int kLeaf = static_cast<int>(Leaf::DIM);

constexpr const char* kSampling = "sampling the solid";

/// In units of the spacing: how near to a grid point the surface may cut an edge.
constexpr double kNearest = 0.01;
/// Values of larger size are cut off; only those at the surface matter.
constexpr double kFarthest = 1000;

/// Makes the blocks that contain all grid points within the solid's reach of a ball, and those next to them,
/// between which the surface is interpolated.
void make_leaves(const Solid& solid, std::span<const Ball> balls, const Grid& grid,
                 openvdb::FloatGrid& values, const core::Progress& progress) {
  auto accessor = values.getAccessor();
  const double reach = solid.reach() / grid.spacing + 1;
  for (const Ball& ball : balls) {
    progress.throw_if_cancelled();
    const Point center = (ball.center - grid.origin) / grid.spacing;
    int first[3];
    int last[3];
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int>(std::floor((center[axis] - reach) / kLeaf));
      last[axis] = static_cast<int>(std::floor((center[axis] + reach) / kLeaf));
    }
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int k = first[2]; k <= last[2]; ++k) {
          const Point low = Point(i, j, k) * static_cast<double>(kLeaf);
          const Point nearest = center.cwiseMax(low).cwiseMin(low + Point::Constant(kLeaf - 1));
          if ((nearest - center).norm() <= reach) accessor.touchLeaf({i * kLeaf, j * kLeaf, k * kLeaf});
        }
  }
}

void sample(const Solid& solid, std::span<const Ball> balls, const Grid& grid, openvdb::FloatGrid& values,
            const core::Progress& progress) {
  std::vector<Leaf*> leaves;
  values.tree().getNodes(leaves);
  std::vector<Point> centers;
  centers.reserve(balls.size());
  for (const Ball& ball : balls) centers.push_back(ball.center);
  const core::PointSearch search(centers);
  const double half_diagonal = std::sqrt(3.0) / 2 * (kLeaf - 1) * grid.spacing;

  constexpr std::size_t kRound = 2048;  // leaves between two reports of progress
  for (std::size_t begin = 0; begin < leaves.size(); begin += kRound) {
    progress.update(kSampling, static_cast<double>(begin) / static_cast<double>(leaves.size()));
    core::parallel_for(
        begin, std::min(begin + kRound, leaves.size()), 4, [&](std::size_t first, std::size_t last) {
          std::vector<Index> near;
          std::vector<Point> places(Leaf::SIZE);
          std::vector<double> results(Leaf::SIZE);
          for (std::size_t l = first; l < last; ++l) {
            progress.throw_if_cancelled();
            Leaf& leaf = *leaves[l];
            for (openvdb::Index n = 0; n < Leaf::SIZE; ++n) {
              const openvdb::Coord at = leaf.offsetToGlobalCoord(n);
              places[n] = grid.origin + grid.spacing * Point(at.x(), at.y(), at.z());
            }
            search.within((places.front() + places.back()) / 2,
                          solid.influence() + half_diagonal * (1 + 1e-9), near);
            solid.evaluate(places, near, results);
            for (openvdb::Index n = 0; n < Leaf::SIZE; ++n) {
              const double size = std::clamp(std::abs(results[n]) / grid.spacing, kNearest, kFarthest);
              leaf.setValueOn(n, static_cast<float>(results[n] < 0 ? -size : size));
            }
          }
        });
  }
}

}  // namespace

double grid_size(const Solid& solid, std::span<const Ball> balls, double spacing) {
  core::BoundingBox box{balls.front().center, balls.front().center};
  for (const Ball& ball : balls) {
    box.min = box.min.cwiseMin(ball.center);
    box.max = box.max.cwiseMax(ball.center);
  }
  const double margin = solid.reach() + kLeaf * spacing;  // a block more on each side
  const double in_box = ((box.max - box.min) / spacing + Point::Constant(2 * margin / spacing)).prod();
  const double around_balls = static_cast<double>(balls.size()) * std::pow(2 * margin / spacing, 3);
  return std::min(in_box, around_balls);
}

QuadMesh mesh_solid(const Solid& solid, std::span<const Ball> balls, const Grid& grid,
                    const core::Progress& progress) {
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr values = openvdb::FloatGrid::create(static_cast<float>(kFarthest));
  progress.update(kSampling, 0);
  make_leaves(solid, balls, grid, *values, progress);
  sample(solid, balls, grid, *values, progress);

  progress.update("making the surface", 0);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  core::detail::run_in_arena([&] { openvdb::tools::volumeToMesh(*values, points, quads, 0.0); });
  QuadMesh mesh;
  mesh.positions.reserve(points.size());
  for (const openvdb::Vec3s& p : points)
    mesh.positions.push_back(grid.origin + grid.spacing * Point(p.x(), p.y(), p.z()));
  mesh.quads.reserve(quads.size());
  for (const openvdb::Vec4I& q : quads) mesh.quads.push_back({q[0], q[1], q[2], q[3]});
  return mesh;
}

}  // namespace morsel::tools
