#include "morsel/morse/functions/atomic_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;

constexpr const char* kStep = "atomic density";
constexpr std::array<const char*, 2> kWeights = {"one", "charge"};  // as AtomWeight has them

void check(const AtomicDensityOptions& options, std::span<const core::Atom> atoms) {
  if (!(options.decay > 0) || !std::isfinite(options.decay))
    throw core::InvalidArgument("the decay of an atomic density must be positive, not " +
                                core::shortest(options.decay));
  if (!(options.cutoff > 0 && options.cutoff < 1))
    throw core::InvalidArgument("the cut-off of an atomic density must lie between 0 and 1, not be " +
                                core::shortest(options.cutoff));
  if (atoms.empty()) throw core::InvalidArgument("an atomic density needs at least one atom");
  for (const core::Atom& atom : atoms) {
    if (!atom.position.allFinite() || !(atom.radius > 0) || !std::isfinite(atom.radius))
      throw core::InvalidArgument(atom.described() + " has no finite position and positive radius");
    if (options.weight == AtomWeight::charge && !(atom.charge && std::isfinite(*atom.charge)))
      throw core::InvalidArgument(atom.described() + " has no finite charge");
  }
}

std::string shown(const core::BoundingBox& box) {
  const auto point = [](const Point& p) {
    std::string text;
    for (const double x : p)
      text += (text.empty() ? "(" : ", ") + core::shortest(std::round(x * 1000) / 1000);
    return text + ")";
  };
  return point(box.min) + " to " + point(box.max);
}

class AtomicDensity final : public core::MorseFunction {
 public:
  AtomicDensity(std::filesystem::path structure, core::MoleculeOptions molecule, AtomicDensityOptions options)
      : structure_(std::move(structure)), molecule_(std::move(molecule)), options_(options) {}

  core::FunctionResult evaluate(const core::TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    const core::Molecule molecule = core::read_molecule(structure_, molecule_, context.progress);
    if (options_.weight == AtomWeight::charge && !molecule.atoms.front().charge)
      throw core::BadInput(structure_.string() +
                           " has no charges of atoms, which weight=charge needs: PQR files have them");
    core::Parameters parameters = {
        {"structure", structure_.string()}, {"decay", options_.decay}, {"cutoff", options_.cutoff}};
    parameters.emplace_back("weight", std::string(kWeights[static_cast<std::size_t>(options_.weight)]));
    core::MoleculeOptions resolved = molecule_;
    if (molecule.radii == core::AtomRadii::all_atom || molecule.radii == core::AtomRadii::united_atom)
      resolved.radii = to_string(molecule.radii);
    for (auto& parameter : core::molecule_parameters(resolved)) parameters.push_back(std::move(parameter));
    parameters.emplace_back("atoms", static_cast<std::int64_t>(molecule.atoms.size()));
    return {atomic_density(mesh, molecule.atoms, options_, context.progress), std::move(parameters),
            molecule.warnings};
  }

 private:
  std::filesystem::path structure_;
  core::MoleculeOptions molecule_;
  AtomicDensityOptions options_;
};

}  // namespace

core::ScalarField atomic_density(const core::TriangleMesh& mesh, std::span<const core::Atom> atoms,
                                 const AtomicDensityOptions& options, const core::Progress& progress) {
  check(options, atoms);
  std::vector<Point> centers;
  centers.reserve(atoms.size());
  core::BoundingBox box{atoms[0].position, atoms[0].position};
  double largest = 0;
  for (const core::Atom& atom : atoms) {
    centers.push_back(atom.position);
    box.min = box.min.cwiseMin(atom.position);
    box.max = box.max.cwiseMax(atom.position);
    largest = std::max(largest, atom.radius);
  }
  const core::PointSearch search(centers);
  const double most = -std::log(options.cutoff) / options.decay;  // d² / r² of a term that counts
  const double reach = largest * std::sqrt(most) * (1 + 1e-9);

  std::vector<double> values(mesh.vertex_count());
  std::vector<std::uint8_t> is_near(values.size());
  constexpr std::size_t kRound = 1 << 16;
  constexpr std::size_t kVertices = 256;
  for (std::size_t begin = 0; begin < values.size(); begin += kRound) {
    progress.update(kStep, static_cast<double>(begin) / static_cast<double>(values.size()));
    core::parallel_for(
        begin, std::min(begin + kRound, values.size()), kVertices, [&](std::size_t first, std::size_t last) {
          std::vector<Index> near;
          for (std::size_t v = first; v < last; ++v) {
            const Point& x = mesh.position(static_cast<Index>(v));
            search.within(x, reach, near);
            for (const Index i : near) {
              const double square = (x - centers[i]).squaredNorm() / (atoms[i].radius * atoms[i].radius);
              if (square > most) continue;
              is_near[v] = 1;
              const double weight = options.weight == AtomWeight::charge ? *atoms[i].charge : 1;
              values[v] += weight * std::exp(-options.decay * square);
            }
          }
        });
  }
  if (std::all_of(is_near.begin(), is_near.end(), [](std::uint8_t near) { return near == 0; }))
    throw core::BadInput("no vertex of the mesh lies within " +
                         core::shortest(std::round(reach * 100) / 100) +
                         " Å of an atom: the mesh reaches from " + shown(mesh.bounding_box()) + ", the " +
                         std::to_string(atoms.size()) + " atoms from " + shown(box) +
                         "; the mesh must lie where the atoms are, in Å");
  return {mesh, std::move(values)};
}

std::unique_ptr<core::MorseFunction> make_atomic_density(core::ParameterReader& reader) {
  const std::filesystem::path structure = reader.file(
      "structure", nullptr, "the molecule of the surface: a .pdb, .ent, .cif, .mmcif or .pqr file");
  AtomicDensityOptions options;
  options.decay = reader.number("decay", options.decay, core::kPositive,
                                "D of the sum of exp(-D d²/r²) over the atoms, r their van der Waals radii");
  options.cutoff =
      reader.number("cutoff", options.cutoff, {0, true, 0.999999}, "terms below this are left out");
  const std::string weight =
      reader.choice("weight", kWeights[0], {kWeights.begin(), kWeights.end()},
                    "what an atom's Gaussian is multiplied with: its charge (of a .pqr)");
  options.weight = weight == kWeights[0] ? AtomWeight::one : AtomWeight::charge;
  core::MoleculeOptions molecule = core::read_molecule_options(reader);
  if (!structure.empty()) core::require_molecules("atomic-density");  // empty: for help
  return std::make_unique<AtomicDensity>(structure, std::move(molecule), options);
}

}  // namespace morsel::morse
