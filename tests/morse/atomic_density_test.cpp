#include "morsel/morse/functions/atomic_density.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "support/made.h"
#include "support/meshes.h"
#include "support/molecules.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using Catch::Contains;
using core::Atom;

namespace {

core::FunctionResult evaluate_density(const TriangleMesh& mesh, Given given) {
  return made(morse::make_atomic_density, "atomic-density", std::move(given))->evaluate(mesh, {});
}

TriangleMesh scaled(const TriangleMesh& mesh, double factor, const Point& shift) {
  std::vector<Point> positions;
  for (const Point& p : mesh.positions()) positions.push_back(factor * p + shift);
  return mesh.with_positions(std::move(positions));
}

}  // namespace

TEST_CASE("atomic density of a lone atom depends on the distance alone") {
  const TriangleMesh mesh = octahedron().mesh();  // all vertices at distance 1
  for (const double decay : {0.5, 1.0, 2.3}) {
    const core::ScalarField field =
        morse::atomic_density(mesh, std::vector<Atom>{atom_at({0, 0, 0}, 1.6)}, {decay, 1e-12});
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(field.value(v) == Approx(std::exp(-decay / (1.6 * 1.6))).epsilon(1e-15));
  }
  const core::ScalarField two = morse::atomic_density(
      mesh, std::vector<Atom>{atom_at({0, 0, 2}, 1), atom_at({0, 0, -3}, 2)}, {1, 1e-300});
  CHECK(two.value(0) == Approx(std::exp(-1.0) + std::exp(-4.0)));
  CHECK(two.value(1) == Approx(std::exp(-9.0) + std::exp(-1.0)));
  CHECK(two.value(2) == Approx(std::exp(-5.0) + std::exp(-2.5)));
}

TEST_CASE("atomic density is the sum over all atoms but for the cut-off") {
  const std::vector<Atom> atoms = random_molecule(3, 200);
  const TriangleMesh mesh = scaled(sphere(3).mesh(), 8, {1, 2, 3});
  for (const double cutoff : {1e-12, 1e-3}) {
    const core::ScalarField field = morse::atomic_density(mesh, atoms, {0.5, cutoff});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      double sum = 0;
      for (const Atom& atom : atoms) {
        const double term =
            std::exp(-0.5 * (mesh.position(v) - atom.position).squaredNorm() / (atom.radius * atom.radius));
        if (term >= cutoff) sum += term;
      }
      CHECK(field.value(v) == Approx(sum).epsilon(1e-13));
    }
  }
}

TEST_CASE("atomic density has the same bits for any number of threads and moves with the molecule") {
  std::vector<Atom> atoms = random_molecule(4, 100);
  const TriangleMesh mesh = scaled(sphere(4).mesh(), 6, {0, 0, 0});
  std::vector<std::vector<double>> values;
  for (const int threads : {1, 4}) {
    const core::ThreadLimit limit(threads);
    const core::ScalarField field = morse::atomic_density(mesh, atoms);
    values.emplace_back(field.values().begin(), field.values().end());
  }
  CHECK(values[0] == values[1]);
  for (Atom& atom : atoms) atom.position += Point(50, 60, -70);
  const core::ScalarField moved = morse::atomic_density(scaled(mesh, 1, {50, 60, -70}), atoms);
  for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(moved.value(v) == Approx(values[0][v]).epsilon(1e-9));
}

TEST_CASE("atomic density reads its molecule and reports the atoms taken") {
  const Scratch folder;
  const std::string file = folder
                               .file("x.pdb", pdb_text({{"C1"},
                                                        {"O", "HOH", "A", 2, {0, 0, 2}, "O", true},
                                                        {"C1", "GLY", "B", 1, {0, 0, -2}, "C"}}))
                               .string();
  const TriangleMesh mesh = octahedron().mesh();
  const auto term = [](double distance, double radius) {
    return std::exp(-0.5 * distance * distance / (radius * radius));
  };
  const core::FunctionResult plain = evaluate_density(mesh, {{"structure", file}});
  CHECK(plain.field.value(0) == Approx(term(1, 1.7) + term(3, 1.7)));
  const core::Parameters expected = {{"structure", file},
                                     {"decay", 0.5},
                                     {"cutoff", 1e-12},
                                     {"weight", std::string("one")},
                                     {"hetero", std::string("residues")},
                                     {"waters", false},
                                     {"hydrogens", true},
                                     {"altloc", std::string("highest")},
                                     {"chains", std::string()},
                                     {"model", std::int64_t{1}},
                                     {"radii", std::string("all-atom")},
                                     {"atoms", std::int64_t{2}}};
  CHECK(plain.parameters == expected);
  const core::FunctionResult chosen =
      evaluate_density(mesh, {{"structure", file}, {"waters", "yes"}, {"chains", "A"}, {"decay", "2"}});
  CHECK(chosen.field.value(0) == Approx(std::pow(term(1, 1.7), 4) + std::pow(term(1, 1.52), 4)));
}

TEST_CASE("atomic density of charges is the sum of signed Gaussians") {
  const Scratch folder;
  const std::string file = folder
                               .file("x.pqr",
                                     "ATOM 1 N GLY 1 0 0 2 -0.5 1.5\n"
                                     "ATOM 2 CA GLY 1 0 0 -2 0.25 2\n"
                                     "ATOM 3 HA GLY 1 0 0 -1 0.1 0\n")
                               .string();
  const TriangleMesh mesh = octahedron().mesh();
  const auto term = [](double distance, double radius) {
    return std::exp(-0.5 * distance * distance / (radius * radius));
  };
  const core::FunctionResult charges = evaluate_density(mesh, {{"structure", file}, {"weight", "charge"}});
  CHECK(charges.field.value(0) == Approx(-0.5 * term(1, 1.5) + 0.25 * term(3, 2)));
  CHECK(charges.field.value(1) == Approx(-0.5 * term(3, 1.5) + 0.25 * term(1, 2)));
  CHECK(evaluate_density(mesh, {{"structure", file}}).field.value(0) == Approx(term(1, 1.5) + term(3, 2)));
  const std::string pdb = folder.file("x.pdb", pdb_text({{"C1"}})).string();
  CHECK_THROWS_WITH(evaluate_density(mesh, {{"structure", pdb}, {"weight", "charge"}}),
                    Contains("no charges"));
}

TEST_CASE("atomic density refuses invalid options") {
  const TriangleMesh mesh = octahedron().mesh();
  const std::vector<Atom> far = {atom_at({500, 0, 0}, 1.7)};
  CHECK_THROWS_WITH(morse::atomic_density(mesh, far),
                    Contains("no vertex of the mesh") && Contains("(500, 0, 0)"));
  CHECK_THROWS_AS(morse::atomic_density(mesh, far), core::BadInput);
  CHECK_THROWS_AS(morse::atomic_density(mesh, {}), core::InvalidArgument);
  const std::vector<Atom> near = {atom_at({0, 0, 0}, 1.7)};
  CHECK_THROWS_AS(morse::atomic_density(mesh, near, {0, 1e-12}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::atomic_density(mesh, near, {INFINITY, 1e-12}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::atomic_density(mesh, near, {1, 0}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::atomic_density(mesh, near, {1, 1}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::atomic_density(mesh, std::vector<Atom>{atom_at({0, 0, 0}, 0)}),
                  core::InvalidArgument);
  CHECK_THROWS_WITH(evaluate_density(mesh, {}), Contains("structure"));
  CHECK_THROWS_WITH(evaluate_density(mesh, {{"structure", "x.pdb"}, {"decay", "-1"}}), Contains("decay"));
  CHECK_THROWS_WITH(evaluate_density(mesh, {{"structure", "x.pdb"}, {"altloc", "AB"}}), Contains("\"AB\""));
  CHECK_THROWS_AS(evaluate_density(mesh, {{"structure", "nowhere.pdb"}}), core::BadInput);
}
