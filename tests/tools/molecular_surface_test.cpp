#include "morsel/tools/molecule/surface.h"

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stop_token>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "support/molecules.h"

using namespace morsel;
using namespace morsel::test;
using core::Atom;
using core::Index;
using core::Point;
using core::TriangleMesh;
using tools::MolecularSurface;
using tools::SurfaceKind;
using tools::SurfaceOptions;

namespace {

constexpr SurfaceKind kKinds[] = {SurfaceKind::gaussian, SurfaceKind::ses, SurfaceKind::sas,
                                  SurfaceKind::vdw};

SurfaceOptions options(SurfaceKind kind, double resolution) {
  SurfaceOptions result;
  result.kind = kind;
  result.resolution = resolution;
  return result;
}

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const core::Triangle& t : mesh.triangles()) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) corners.row(i) = mesh.position(t[i]);
    volume += corners.determinant() / 6;
  }
  return volume;
}

/// The guarantees of the interface, for any atoms.
void check_promise(const MolecularSurface& surface) {
  CHECK_NOTHROW(surface.mesh.validate());
  CHECK(surface.mesh.is_closed());
  CHECK(surface.volume > 0);
  CHECK(surface.area > 0);
  CHECK(signed_volume(surface.mesh) == Approx(surface.volume));
  const auto triangles = surface.mesh.triangles();
  CHECK(std::all_of(triangles.begin(), triangles.end(), [&](const core::Triangle& t) {
    const Point &a = surface.mesh.position(t[0]), &b = surface.mesh.position(t[1]),
                &c = surface.mesh.position(t[2]);
    return a != b && b != c && c != a;
  }));
}

/// The largest and smallest of what `distance` is at the vertices.
template <class Distance>
std::pair<double, double> range(const TriangleMesh& mesh, const Distance& distance) {
  double least = std::numeric_limits<double>::max(), most = -least;
  for (const Point& p : mesh.positions()) {
    least = std::min(least, distance(p));
    most = std::max(most, distance(p));
  }
  return {least, most};
}

double distance_to_balls(const Point& p, const std::vector<Atom>& atoms, double grown = 0) {
  double least = std::numeric_limits<double>::max();
  for (const Atom& atom : atoms) least = std::min(least, (p - atom.position).norm() - atom.radius - grown);
  return least;
}

}  // namespace

TEST_CASE("the surface of a lone atom is a sphere of its radius") {
  const std::vector<Atom> atoms = {atom_at({10, -20, 30.5}, 1.7)};
  for (const SurfaceKind kind : kKinds)
    for (const double h : {0.25, 0.1}) {
      const MolecularSurface surface = tools::molecular_surface(atoms, options(kind, h));
      check_promise(surface);
      CHECK(surface.mesh.euler_characteristic() == 2);
      CHECK(surface.mesh.component_count() == 1);
      const double radius = kind == SurfaceKind::sas ? 3.1 : 1.7;
      const auto [least, most] =
          range(surface.mesh, [&](const Point& p) { return (p - atoms[0].position).norm(); });
      // A vertex is the mean of chords' points: a little inside, by the square of the spacing.
      CHECK(least > radius - h * h / radius - 0.02 * h);
      CHECK(most < radius + 0.02 * h);
      CHECK(surface.volume == Approx(4 * std::numbers::pi / 3 * std::pow(radius, 3)).epsilon(2 * h * h));
      CHECK(surface.area == Approx(4 * std::numbers::pi * radius * radius).epsilon(2 * h * h));
    }
}

TEST_CASE("atoms apart have a component each") {
  const std::vector<Atom> atoms = {atom_at({0, 0, 0}, 1.5), atom_at({30, 0, 0}, 1.2),
                                   atom_at({0, 2000, 5}, 2)};
  for (const SurfaceKind kind : kKinds) {
    const MolecularSurface surface = tools::molecular_surface(atoms, options(kind, 0.4));
    check_promise(surface);
    CHECK(surface.mesh.component_count() == 3);
    CHECK(surface.mesh.euler_characteristic() == 6);
  }
}

TEST_CASE("a ring of atoms has a hole") {
  const std::vector<Atom> atoms = ring_molecule(16, 7, 1.7);
  for (const SurfaceKind kind : kKinds) {
    const MolecularSurface surface = tools::molecular_surface(atoms, options(kind, 0.5));
    check_promise(surface);
    CHECK(surface.mesh.genus() == 1);
    CHECK(surface.mesh.component_count() == 1);
  }
  // From above and below, a probe reaches the middle if its radius is below (7² − 1.7²) / (2 · 1.7) = 13.6.
  for (const auto& [probe, genus] : {std::pair(12.0, 1u), std::pair(25.0, 0u)}) {
    SurfaceOptions large = options(SurfaceKind::ses, 0.9);
    large.probe = probe;
    const MolecularSurface surface = tools::molecular_surface(atoms, large);
    check_promise(surface);
    CHECK(surface.mesh.genus() == genus);
  }
}

TEST_CASE("the solvent excluded surface of two atoms is the analytic one") {
  // Two balls of radius r, 2 c apart: spheres, and between them the inner half of a torus along which the
  // probe rolls.
  const double r = 1.7, c = 2, probe = 1.4, h = 0.1;
  const std::vector<Atom> atoms = {atom_at({-c, 0, 0}, r), atom_at({c, 0, 0}, r)};
  const MolecularSurface surface = tools::molecular_surface(atoms, options(SurfaceKind::ses, h));
  check_promise(surface);
  CHECK(surface.mesh.component_count() == 1);
  CHECK(surface.mesh.genus() == 0);
  const double around =
      std::sqrt((r + probe) * (r + probe) - c * c);  // radius of the circle of the probe's center
  const double touching = c * probe / (r + probe);   // |x| of where the torus meets the spheres
  const auto error = [&](const Point& p) {
    const double x = std::abs(p.x()), away = std::hypot(p.y(), p.z());
    if (x < touching) return std::abs(probe - std::hypot(x, away - around));
    return std::abs(std::hypot(x - c, away) - r);
  };
  CHECK(range(surface.mesh, error).second < h * h + 0.02 * h);
  // It lies around the balls and within those that are larger by the probe.
  CHECK(range(surface.mesh, [&](const Point& p) { return distance_to_balls(p, atoms); }).first > -0.2 * h);
  CHECK(range(surface.mesh, [&](const Point& p) { return distance_to_balls(p, atoms, probe); }).second < 0);
  // With a probe that passes between them they are two spheres.
  SurfaceOptions small = options(SurfaceKind::ses, h);
  small.probe = 0.2;
  CHECK(tools::molecular_surface(atoms, small).mesh.component_count() == 2);
}

TEST_CASE("the solvent excluded surface is where sampled probes end") {
  // The oracle: p is outside if some center on a fine grid, free of all atoms, has it within the probe's
  // radius.
  const double probe = 1.4, step = 0.1;
  for (unsigned seed = 0; seed < 3; ++seed) {
    const std::vector<Atom> atoms = random_molecule(seed, 5);
    const MolecularSurface surface = tools::molecular_surface(atoms, options(SurfaceKind::ses, 0.4));
    std::vector<Point> centers;
    const core::BoundingBox& box = surface.mesh.bounding_box();
    const Point low = box.min - Point::Constant(2 * probe), high = box.max + Point::Constant(2 * probe);
    for (double x = low.x(); x < high.x(); x += step)
      for (double y = low.y(); y < high.y(); y += step)
        for (double z = low.z(); z < high.z(); z += step) {
          const double away = distance_to_balls({x, y, z}, atoms, probe);
          if (away >= 0 && away < 2 * step) centers.emplace_back(x, y, z);
        }
    double worst = 0;
    for (Index v = 0; v < surface.mesh.vertex_count(); v += 7) {
      double nearest = std::numeric_limits<double>::max();
      for (const Point& center : centers)
        nearest = std::min(nearest, (center - surface.mesh.position(v)).squaredNorm());
      worst = std::max(worst, std::abs(std::sqrt(nearest) - probe));
    }
    CHECK(worst < 0.5 * 0.4 + step);
  }
}

TEST_CASE("the Gaussian surface is a level of the density") {
  const std::vector<Atom> atoms = random_molecule(11, 12);
  SurfaceOptions wanted = options(SurfaceKind::gaussian, 0.1);
  wanted.blobbiness = 1.5;
  const MolecularSurface surface = tools::molecular_surface(atoms, wanted);
  const auto [least, most] = range(surface.mesh, [&](const Point& p) {
    double density = 0;
    for (const Atom& a : atoms)
      density += std::exp(1.5 * (1 - (p - a.position).squaredNorm() / (a.radius * a.radius)));
    return density;
  });
  CHECK(least > 0.95);
  CHECK(most < 1.05);
}

TEST_CASE("surfaces of random molecules are closed manifolds") {
  for (unsigned seed = 0; seed < 12; ++seed)
    for (const SurfaceKind kind : kKinds) {
      CAPTURE(seed, static_cast<int>(kind));
      const MolecularSurface surface = tools::molecular_surface(
          random_molecule(seed, 3 + static_cast<int>(seed) * 4), options(kind, seed % 3 == 0   ? 0.37
                                                                               : seed % 3 == 1 ? 0.7
                                                                                               : 1.2));
      check_promise(surface);
    }
}

TEST_CASE("atoms on grid points, in one place or just touching give manifolds") {
  const std::vector<std::vector<Atom>> molecules = {
      {atom_at({0, 0, 0}, 1.5), atom_at({0, 0, 0}, 1.5)},    // one upon the other
      {atom_at({0, 0, 0}, 2), atom_at({0.5, 0, 0}, 1)},      // one within the other
      {atom_at({0, 0, 0}, 1.5), atom_at({3, 0, 0}, 1.5)},    // touching
      {atom_at({0, 0, 0}, 1.5), atom_at({5.8, 0, 0}, 1.5)},  // touching, with the probe
      {atom_at({0, 0, 0}, 1), atom_at({2, 0, 0}, 1), atom_at({0, 2, 0}, 1), atom_at({2, 2, 0}, 1),
       atom_at({0, 0, 2}, 1), atom_at({2, 0, 2}, 1), atom_at({0, 2, 2}, 1),
       atom_at({2, 2, 2}, 1)}};  // a crystal
  for (const auto& atoms : molecules)
    for (const SurfaceKind kind : kKinds)
      for (const double h : {0.5, 0.25}) check_promise(tools::molecular_surface(atoms, options(kind, h)));
}

TEST_CASE("cavities are dropped unless asked for") {
  // Atoms all over a sphere enclose a room.
  std::vector<Atom> atoms;
  for (int i = 0; i < 200; ++i) {
    const double z = 1 - (2 * i + 1) / 200.0, angle = i * std::numbers::pi * (3 - std::sqrt(5));
    atoms.push_back(atom_at(
        8 * Point(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z), 1.7));
  }
  for (const SurfaceKind kind : {SurfaceKind::ses, SurfaceKind::gaussian}) {
    SurfaceOptions wanted = options(kind, 0.5);
    const MolecularSurface outer = tools::molecular_surface(atoms, wanted);
    check_promise(outer);
    CHECK(outer.mesh.component_count() == 1);
    CHECK(outer.cavities == 1);
    wanted.cavities = true;
    const MolecularSurface both = tools::molecular_surface(atoms, wanted);
    check_promise(both);
    CHECK(both.mesh.component_count() == 2);
    CHECK(both.cavities == 1);
    CHECK(both.volume < outer.volume);
    CHECK(both.area > outer.area);
    // An atom that floats in it is a part of the molecule, not a cavity.
    std::vector<Atom> more = atoms;
    more.push_back(atom_at({0.1, 0, 0}, 1.5));
    wanted.cavities = false;
    CHECK(tools::molecular_surface(more, wanted).mesh.component_count() == 2);
  }
}

TEST_CASE("a moved molecule has the moved surface and threads change nothing") {
  std::vector<Atom> atoms = random_molecule(5, 40);
  for (const SurfaceKind kind : kKinds) {
    std::vector<MolecularSurface> surfaces;
    for (const int threads : {1, 4}) {
      const core::ThreadLimit limit(threads);
      surfaces.push_back(tools::molecular_surface(atoms, options(kind, 0.5)));
    }
    const auto same = [](const auto& a, const auto& b) {
      return std::equal(a.begin(), a.end(), b.begin(), b.end());
    };
    CHECK(same(surfaces[0].mesh.positions(), surfaces[1].mesh.positions()));
    CHECK(same(surfaces[0].mesh.triangles(), surfaces[1].mesh.triangles()));
    std::vector<Atom> moved = atoms;
    for (Atom& atom : moved) atom.position += Point(64, -128, 32);
    const MolecularSurface there = tools::molecular_surface(moved, options(kind, 0.5));
    CHECK(there.volume == Approx(surfaces[0].volume).epsilon(1e-3));
    CHECK(there.mesh.euler_characteristic() == surfaces[0].mesh.euler_characteristic());
  }
}

TEST_CASE("surfaces that cannot be made are refused") {
  const std::vector<Atom> atoms = {atom_at({0, 0, 0}, 1.7), atom_at({40, 0, 0}, 1.2)};
  const auto with = [&](auto change) {
    SurfaceOptions wanted;
    change(wanted);
    return tools::molecular_surface(atoms, wanted);
  };
  CHECK_THROWS_AS(with([](SurfaceOptions& o) { o.resolution = 0; }), core::InvalidArgument);
  CHECK_THROWS_AS(with([](SurfaceOptions& o) { o.resolution = NAN; }), core::InvalidArgument);
  CHECK_THROWS_AS(with([](SurfaceOptions& o) { o.probe = 0; }), core::InvalidArgument);
  CHECK_THROWS_AS(with([](SurfaceOptions& o) { o.blobbiness = 0.01; }), core::InvalidArgument);
  CHECK_THROWS_WITH(with([](SurfaceOptions& o) { o.resolution = 1.5; }),
                    Catch::Contains("too coarse") && Catch::Contains("1.38 Å would do"));
  CHECK_NOTHROW(with([](SurfaceOptions& o) { o.resolution = 1.38; }));
  CHECK_THROWS_WITH(with([](SurfaceOptions& o) { o.resolution = 1e-3; }), Catch::Contains("a grid of"));
  CHECK_THROWS_WITH(with([](SurfaceOptions& o) { o.resolution = 1e-300; }), Catch::Contains("a grid of"));
  CHECK_THROWS_AS(tools::molecular_surface({}), core::BadInput);
  CHECK_THROWS_AS(tools::molecular_surface(std::vector<Atom>{atom_at({0, 0, 0}, 0)}), core::BadInput);
  CHECK_THROWS_AS(tools::molecular_surface(std::vector<Atom>{atom_at({0, 0, INFINITY}, 1)}), core::BadInput);
  CHECK_THROWS_AS(
      tools::molecular_surface(std::vector<Atom>{atom_at({0, 0, 0}, 1.5), atom_at({9e6, 0, 0}, 1.5)}),
      core::BadInput);
}

TEST_CASE("a surface that is being made can be stopped") {
  std::stop_source stop;
  const core::Progress progress([&](std::string_view, double) { stop.request_stop(); }, stop.get_token());
  CHECK_THROWS_AS(tools::molecular_surface(random_molecule(1, 20), {}, progress), core::Cancelled);
}

TEST_CASE(
    "bug: the time of a solvent-excluded surface grew with the cube of the atoms in reach of one another") {
  std::mt19937 random(9);
  std::vector<Atom> atoms;
  for (int i = 0; i < 4000; ++i)
    atoms.push_back(
        atom_at({random() % 10000 / 1000., random() % 10000 / 1000., random() % 10000 / 1000.}, 1.7));
  const MolecularSurface surface = tools::molecular_surface(atoms, options(SurfaceKind::ses, 0.9));
  check_promise(surface);
  // A cube of 10 with everything within 1.7 of it, but for some room between the outermost atoms.
  CHECK(surface.volume < 1000 + 6 * 100 * 1.7 + 30 * std::numbers::pi * 1.7 * 1.7 + 21);
  CHECK(surface.volume > 1800);
}

TEST_CASE("atoms too many of which can be touched at once have no solvent-excluded surface") {
  const std::vector<Atom> atoms(20'000, atom_at({1, 2, 3}, 1.7));
  CHECK_THROWS_WITH(
      tools::molecular_surface(atoms, options(SurfaceKind::ses, 0.9)),
      "a probe of 1.4 Å can touch more than 33554432 pairs of these 20000 atoms, too many for a "
      "solvent-excluded surface; a smaller probe or the kind gaussian would do, unless the atoms "
      "lie one in another");
  CHECK_NOTHROW(tools::molecular_surface(atoms, options(SurfaceKind::vdw, 0.9)));
}
