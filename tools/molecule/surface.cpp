#include "morsel/tools/molecule/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh_defects.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/molecule/grid_mesh.h"
#include "morsel/tools/molecule/solid.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

constexpr int kMostGrids = 8;
constexpr double kMostPoints = 5e8;
constexpr double kLongestSide = 65536;  // vertices come in single precision, in units of the spacing

void check(bool holds, const char* what, double value, const char* range) {
  if (!holds)
    throw core::InvalidArgument(std::string("the ") + what + " of a molecular surface must be " + range +
                                ", not " + core::shortest(value));
}

std::unique_ptr<Solid> make_solid(std::vector<Ball> balls, const SurfaceOptions& options) {
  switch (options.kind) {
    case SurfaceKind::gaussian:
      return gaussian_solid(std::move(balls), options.blobbiness);
    case SurfaceKind::ses:
      return excluded_solid(std::move(balls), options.probe, 2 * options.resolution);
    case SurfaceKind::sas:
      for (Ball& ball : balls) ball.radius += options.probe;
      return ball_solid(std::move(balls));
    case SurfaceKind::vdw:
      return ball_solid(std::move(balls));
  }
  throw core::InvalidArgument("unknown kind of molecular surface");
}

/// `digits` significant digits, upwards.
double rounded_up(double value, int digits) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - digits + 1);
  return std::ceil(value / unit) * unit;
}

void check_resolution(const Solid& solid, std::span<const Ball> balls, std::span<const core::Atom> atoms,
                      const SurfaceOptions& options, const core::BoundingBox& box) {
  const double spacing = options.resolution;
  const std::string given = "a resolution of " + core::shortest(spacing) + " Å ";
  const auto smallest =
      std::min_element(atoms.begin(), atoms.end(),
                       [](const core::Atom& a, const core::Atom& b) { return a.radius < b.radius; });
  if (options.kind != SurfaceKind::sas && std::sqrt(3.0) / 2 * spacing > smallest->radius)
    throw core::BadInput(given + "is too coarse for " + smallest->described() + " with its radius of " +
                         core::shortest(smallest->radius) + " Å; at most " +
                         core::shortest(std::floor(smallest->radius / std::sqrt(3.0) * 200) / 100) +
                         " Å would do");
  const double side = ((box.max - box.min).maxCoeff() + 2 * solid.reach()) / spacing;
  const double points = grid_size(solid, balls, spacing);
  if (side <= kLongestSide && points <= kMostPoints) return;
  const double enough = spacing * std::max(side / kLongestSide, std::cbrt(points / kMostPoints));
  throw core::BadInput(given + "would take a grid of " + core::shortest(rounded_up(points, 2)) + " points, " +
                       core::shortest(rounded_up(side, 2)) +
                       " along its longest side, where 5e8 and 65536 are possible: from about " +
                       core::shortest(rounded_up(enough, 2)) + " Å on it would do");
}

double smallest_angle_cosine(const Point& a, const Point& b, const Point& c) {
  const auto cosine = [](const Point& u, const Point& v) {
    const double lengths = u.norm() * v.norm();
    return lengths > 0 ? u.dot(v) / lengths : 1;
  };
  return std::max({cosine(b - a, c - a), cosine(c - b, a - b), cosine(a - c, b - c)});
}

std::vector<core::Triangle> triangulate(const QuadMesh& quads) {
  std::vector<core::Triangle> triangles;
  triangles.reserve(2 * quads.quads.size());
  const auto worst = [&](const core::Triangle& s, const core::Triangle& t) {
    const std::vector<Point>& p = quads.positions;
    return std::max(smallest_angle_cosine(p[s[0]], p[s[1]], p[s[2]]),
                    smallest_angle_cosine(p[t[0]], p[t[1]], p[t[2]]));
  };
  for (const auto& [a, b, c, d] : quads.quads) {
    const std::array<core::Triangle, 2> first = {{{a, b, c}, {a, c, d}}};
    const std::array<core::Triangle, 2> second = {{{b, c, d}, {b, d, a}}};
    const auto& better = worst(first[0], first[1]) <= worst(second[0], second[1]) ? first : second;
    triangles.insert(triangles.end(), better.begin(), better.end());
  }
  return triangles;
}

/// A closed manifold; none if it is not one.
std::optional<TriangleMesh> try_grid(const Solid& solid, std::span<const Ball> balls, const Grid& grid,
                                     const core::Progress& progress) {
  QuadMesh quads = mesh_solid(solid, balls, grid, progress);
  std::vector<core::Triangle> triangles = triangulate(quads);
  progress.throw_if_cancelled();
  try {
    TriangleMesh mesh(std::move(quads.positions), std::move(triangles));
    if (mesh.is_closed()) return mesh;
  } catch (const core::MeshError&) {
  }
  return std::nullopt;
}

/// Area and signed volume of each component.
struct Extent {
  double area = 0;
  double volume = 0;
};
std::vector<Extent> component_extents(const TriangleMesh& mesh) {
  std::vector<Extent> extents(mesh.component_count());
  const Point middle = (mesh.bounding_box().min + mesh.bounding_box().max) / 2;  // against cancellation
  for (const core::Triangle& t : mesh.triangles()) {
    const Point a = mesh.position(t[0]) - middle, b = mesh.position(t[1]) - middle,
                c = mesh.position(t[2]) - middle;
    Extent& extent = extents[mesh.component_of_vertex(t[0])];
    extent.area += (b - a).cross(c - a).norm() / 2;
    extent.volume += a.dot(b.cross(c)) / 6;
  }
  return extents;
}

TriangleMesh keep_components(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  std::vector<Index> number(mesh.vertex_count(), core::kNone);
  std::vector<Point> positions;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!keep[mesh.component_of_vertex(v)]) continue;
    number[v] = static_cast<Index>(positions.size());
    positions.push_back(mesh.position(v));
  }
  std::vector<core::Triangle> triangles;
  for (const core::Triangle& t : mesh.triangles())
    if (number[t[0]] != core::kNone) triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return {std::move(positions), std::move(triangles)};
}

/// The wall of a cavity has a negative volume.
MolecularSurface finish(const TriangleMesh& mesh, bool keep_cavities) {
  const std::vector<Extent> extents = component_extents(mesh);
  std::vector<bool> keep(extents.size());
  MolecularSurface surface{mesh};
  for (std::size_t c = 0; c < extents.size(); ++c) {
    const bool cavity = extents[c].volume < 0;
    if (cavity) ++surface.cavities;
    keep[c] = keep_cavities || !cavity;
    if (!keep[c]) continue;
    surface.area += extents[c].area;
    surface.volume += extents[c].volume;
  }
  if (!keep_cavities && surface.cavities > 0) surface.mesh = keep_components(mesh, keep);
  return surface;
}

}  // namespace

std::string to_string(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::gaussian:
      return "gaussian";
    case SurfaceKind::ses:
      return "ses";
    case SurfaceKind::sas:
      return "sas";
    case SurfaceKind::vdw:
      break;
  }
  return "vdw";
}

void check_surface_options(const SurfaceOptions& options) {
  check(options.resolution > 0 && std::isfinite(options.resolution), "resolution", options.resolution,
        "above 0 Å");
  check(options.probe > 0 && options.probe <= 100, "probe radius", options.probe,
        "above 0 and at most 100 Å");
  check(options.blobbiness >= 0.1 && options.blobbiness <= 100, "blobbiness", options.blobbiness,
        "from 0.1 to 100");
}

MolecularSurface molecular_surface(std::span<const core::Atom> atoms, const SurfaceOptions& options,
                                   const core::Progress& progress) {
  check_surface_options(options);
  if (atoms.empty()) throw core::BadInput("a molecular surface needs at least one atom");
  std::vector<Ball> balls;
  balls.reserve(atoms.size());
  core::BoundingBox box{atoms[0].position, atoms[0].position};
  for (const core::Atom& atom : atoms) {
    if (!atom.position.allFinite() || !(atom.radius > 0) || !std::isfinite(atom.radius))
      throw core::BadInput(atom.described() + " has no finite position and positive radius");
    balls.push_back({atom.position, atom.radius});
    box.min = box.min.cwiseMin(atom.position);
    box.max = box.max.cwiseMax(atom.position);
  }
  const std::unique_ptr<Solid> solid = make_solid(balls, options);
  check_resolution(*solid, balls, atoms, options, box);
  for (int tried = 0; tried < kMostGrids; ++tried) {
    // Shifts that fill the cell evenly: multiples of the inverse powers of the root of x⁴ = x + 1.
    Point shift =
        Point::Constant(0.5) + tried * Point(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    for (double& s : shift) s -= std::floor(s);
    const Grid grid{box.min - options.resolution * shift, options.resolution};
    if (const std::optional<TriangleMesh> mesh = try_grid(*solid, balls, grid, progress)) {
      MolecularSurface surface = finish(*mesh, options.cavities);
      surface.grids_tried = tried + 1;
      return surface;
    }
  }
  throw core::BadInput("at a resolution of " + core::shortest(options.resolution) +
                       " Å the surface of these " + std::to_string(atoms.size()) +
                       " atoms pinches on all of " + std::to_string(kMostGrids) +
                       " grids; choose another resolution");
}

}  // namespace morsel::tools
