/// The module morsel._molecule: molecules and their surfaces.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/molecule.h"
#include "morsel/core/text/specification.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/errors.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"
#include "morsel/tools/molecule/surface.h"

namespace morsel::python {
namespace {

using tools::SurfaceKind;
using tools::SurfaceOptions;

SurfaceKind kind_of(const std::string& word) {
  constexpr std::array kKinds = {"gaussian", "ses", "sas", "vdw"};  // as SurfaceKind has them
  for (std::size_t i = 0; i < kKinds.size(); ++i)
    if (word == kKinds[i]) return static_cast<SurfaceKind>(i);
  throw core::InvalidArgument("kind must be one of gaussian, ses, sas, vdw, not \"" + word + "\"");
}

/// `keys` choose the atoms, as those of atomic-density do.
core::MoleculeOptions options_of(const std::string& keys) {
  core::ParameterReader reader(core::parse_specification(keys, "the molecule"));
  core::MoleculeOptions options = core::read_molecule_options(reader);
  reader.finish();
  return options;
}

/// The atoms, column by column.
py::dict columns(const std::vector<core::Atom>& atoms) {
  std::vector<core::Point> positions;
  std::vector<double> radii, charges;
  std::vector<std::int64_t> serials;
  py::list elements, names, residues, chains, sequence_ids;
  for (const core::Atom& atom : atoms) {
    positions.push_back(atom.position);
    radii.push_back(atom.radius);
    charges.push_back(atom.charge.value_or(std::numeric_limits<double>::quiet_NaN()));
    serials.push_back(atom.serial);
    elements.append(text(atom.element));
    names.append(text(atom.name));
    residues.append(text(atom.residue));
    chains.append(text(atom.chain));
    sequence_ids.append(text(atom.sequence_id));
  }
  py::dict result;
  result["position"] = taken_points(std::move(positions));
  result["radius"] = taken(std::move(radii));
  result["charge"] = taken(std::move(charges));
  result["serial"] = taken(std::move(serials));
  result["element"] = elements;
  result["name"] = names;
  result["residue"] = residues;
  result["chain"] = chains;
  result["sequence_id"] = sequence_ids;
  return result;
}

/// (mesh, atoms by column, area, volume, number of cavities, which radii, warnings)
py::tuple molecule(const std::string& path, const std::string& kind, double resolution, double probe,
                   double blobbiness, bool cavities, const std::string& keys, const py::object& report) {
  core::require_molecules("ms.molecule()");
  const SurfaceOptions options{kind_of(kind), resolution, probe, blobbiness, cavities};
  tools::check_surface_options(options);
  const core::MoleculeOptions wanted = options_of(keys);
  auto [read, surface] = compute(report, [&](const core::Progress& progress) {
    core::Molecule atoms = core::read_molecule(path, wanted, progress);
    tools::MolecularSurface made = tools::molecular_surface(atoms.atoms, options, progress);
    return std::pair(std::move(atoms), std::move(made));
  });
  const std::size_t count = surface.mesh.vertex_count();
  const MeshHandle mesh =
      std::make_shared<MeshData>(MeshData{{surface.mesh, {{count, {}, {}}, {}, {}}}, {}, false});
  py::list warnings;
  for (const std::string& warning : read.warnings) warnings.append(text(warning));
  return py::make_tuple(mesh, columns(read.atoms), surface.area, surface.volume, surface.cavities,
                        to_string(read.radii), warnings);
}

}  // namespace
}  // namespace morsel::python

PYBIND11_MODULE(_molecule, m) {
  using namespace morsel::python;
  share_jobs(py::module_::import("morsel._library"));  // which has the type of meshes
  m.doc() = "Surfaces of molecules, as morsel's Python sources make them.";
  translate_errors();
  m.def("molecule", &molecule);
}
