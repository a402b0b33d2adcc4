// morsel molecule: the surface of a molecule.

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/core/io/molecule.h"
#include "morsel/tools/commands/standard_input.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/molecule/surface.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string structure;
  std::string format;  ///< empty: that of its name
  std::string output;
  SurfaceOptions surface;
  bool waters = false;
  bool no_hydrogens = false;
  core::Specification atoms{"molecule", {}};  ///< the rest of what chooses the atoms, as keys
};

/// The options, and the files that they name besides the structure.
struct Wanted {
  core::MoleculeOptions atoms;
  std::vector<core::FileParameter> files;
};
Wanted wanted_atoms(const Options& options) {
  core::Specification keys = options.atoms;
  if (options.waters) keys.given.emplace_back("waters", "yes");
  if (options.no_hydrogens) keys.given.emplace_back("hydrogens", "no");
  core::ParameterReader reader = core::ParameterReader::of_options(std::move(keys));
  Wanted wanted{core::read_molecule_options(reader), {}};
  wanted.files = reader.files();
  return wanted;
}

std::string described(const core::Molecule& molecule) {
  std::string text = "atoms: " + grouped(molecule.atoms.size()) + " of " + grouped(molecule.atoms_in_model);
  if (molecule.left_out.total() > 0) text += "; left out: " + molecule.left_out.described();
  if (molecule.models > 1) text += " (one of " + std::to_string(molecule.models) + " models)";
  return text + "; radii: " + to_string(molecule.radii);
}

std::string described(const MolecularSurface& surface, const Options& options) {
  const core::TriangleMesh& mesh = surface.mesh;
  const auto whole = [](double value) { return grouped(static_cast<std::uint64_t>(std::llround(value))); };
  std::string text = "surface: " + grouped(mesh.vertex_count()) + " vertices, " +
                     grouped(mesh.triangle_count()) + " triangles, " + grouped(mesh.component_count()) +
                     (mesh.component_count() == 1 ? " component" : " components") + ", genus " +
                     grouped(mesh.genus()) + ", area " + whole(surface.area) + " Å², volume " +
                     whole(surface.volume) + " Å³";
  if (surface.cavities > 0)
    text += "; " + grouped(surface.cavities) + (surface.cavities == 1 ? " cavity" : " cavities") +
            (options.surface.cavities ? " among the components" : " dropped (--cavities keep keeps them)");
  if (surface.grids_tried > 1)
    text += "; made on grid " + std::to_string(surface.grids_tried) + ", the surface pinched on those before";
  return text;
}

/// `radii`: those that the atoms have, where the options leave that to the file.
Json request_section(const Options& options, core::MoleculeOptions atoms, core::AtomRadii radii) {
  if (radii == core::AtomRadii::all_atom || radii == core::AtomRadii::united_atom)
    atoms.radii = to_string(radii);
  Json section = {{"kind", to_string(options.surface.kind)},
                  {"resolution", options.surface.resolution},
                  {"probe", options.surface.probe},
                  {"blobbiness", options.surface.blobbiness},
                  {"cavities", options.surface.cavities ? "keep" : "drop"}};
  section.update(to_json(core::molecule_parameters(atoms)));
  return section;
}

/// The atoms of FILE, and its hash.
struct HashedMolecule {
  core::Molecule molecule;
  std::string sha256;
};
HashedMolecule read(const Options& options, const core::MoleculeOptions& atoms, const std::string& name,
                    const core::Progress& progress) {
  std::optional<core::MoleculeFormat> format;
  if (!options.format.empty()) format = core::molecule_format_named(options.format);
  if (options.structure == kStandardInput) {
    const std::string_view bytes = standard_input(progress);
    return {core::parse_molecule(bytes, *format, name, atoms, progress), sha256_of(bytes)};
  }
  return {format ? core::read_molecule(options.structure, *format, atoms, progress)
                 : core::read_molecule(options.structure, atoms, progress),
          sha256_of_file(options.structure)};
}

int make(const Options& options, const Run& run) {
  core::require_molecules("morsel molecule");
  const core::FileTarget output = output_target(options.output, run);
  const std::string extension = core::checked_extension(output, "a surface is written", {".off", ".ply"});
  const bool is_standard_input = options.structure == kStandardInput;
  if (is_standard_input && options.format.empty()) fail_without_format(core::molecule_format_names());
  const Wanted wanted = wanted_atoms(options);
  check_surface_options(options.surface);
  RunFiles files;
  files.reads("FILE", is_standard_input ? "/dev/stdin" : options.structure).writes("-o", output);
  for (const core::FileParameter& file : wanted.files) files.reads("--" + file.key, file.path);
  files.check();
  check_writable(output);
  const core::Progress progress = run.console.progress();
  const std::string name = is_standard_input ? "standard input" : options.structure;
  const auto [molecule, sha256] = read(options, wanted.atoms, name, progress);
  const MolecularSurface surface = molecular_surface(molecule.atoms, options.surface, progress);
  std::vector<HashedFile> inputs = {{options.structure, sha256}};
  for (const core::FileParameter& file : wanted.files)
    inputs.push_back({file.path, sha256_of_file(file.path)});
  const Provenance provenance(run.common.command, request_section(options, wanted.atoms, molecule.radii),
                              inputs);
  if (extension == ".ply")
    core::write_ply(output, surface.mesh, {}, provenance.lines(), progress);
  else
    core::write_off(output, surface.mesh, provenance.lines(), progress);
  for (const std::string& warning : molecule.warnings) run.console.warning(name + ": " + warning);
  run.console.message(described(molecule));
  run.console.message(described(surface, options));
  tell_written("written", output, run);
  return kDone;
}

}  // namespace

void add_molecule(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add("molecule", "Make the surface of a molecule, a closed manifold");
  command.path("FILE", options->structure, "Atoms: .pdb, .ent, .cif, .mmcif or .pqr; - is standard input")
      .required();
  command
      .text("--format", options->format,
            "Read the atoms as this, whatever the file's name; needed where it is -")
      .value("FORMAT")
      .among(core::molecule_format_names());
  add_output_option(command, options->output, {{"off", "ply"}}, "The surface, in Å: .off or .ply")
      .value("SURFACE");
  command
      .choice("--kind", options->surface.kind,
              {SurfaceKind::gaussian, SurfaceKind::ses, SurfaceKind::sas, SurfaceKind::vdw},
              "gaussian, ses, sas or vdw")
      .value("KIND")
      .in_detail(
          "gaussian: a level of a sum of Gaussians, smooth; ses: solvent-excluded; sas: solvent-accessible; "
          "vdw: the atoms' balls");
  command
      .number("--resolution", options->surface.resolution,
              "Spacing of the grid, about an edge's length, in Å")
      .value("H");
  command.number("--probe", options->surface.probe, "Radius of the solvent for ses and sas, in Å").value("R");
  command
      .number("--blobbiness", options->surface.blobbiness,
              "B of exp(B (1 - d²/r²)) for gaussian: the smaller, the smoother")
      .value("B")
      .shortly("How smooth gaussian is");
  command
      .choice("--cavities", options->surface.cavities,
              std::vector<std::pair<std::string, bool>>{{"keep", true}, {"drop", false}},
              "keep or drop the walls of closed cavities inside")
      .value("C");

  // The keys of atomic-density, with their texts.
  core::ParameterReader keys = core::ParameterReader::for_help("molecule");
  core::read_molecule_options(keys);
  for (const core::ParameterInfo& key : keys.declared()) {
    if (key.key == "waters") {
      command.flag("--waters", options->waters, "Take the waters, too");
    } else if (key.key == "hydrogens") {
      command.flag("--no-hydrogens", options->no_hydrogens, "Leave out the hydrogens that the file has");
    } else {
      const bool is_expression = key.key == "select";
      Option row{"--" + key.key, key.description,
                 is_expression               ? "EXPRESSION"
                 : key.default_value.empty() ? "LIST"
                                             : "WHICH",
                 key.default_value};
      if (is_expression) row.excludes("--hetero").excludes("--waters");
      const bool is_list = key.kind == core::ParameterKind::list;
      row.take = [options, name = key.key, is_list](const Option&, const std::vector<std::string>& words) {
        options->atoms.given.emplace_back(name, is_list ? words.back() : core::escape(words.back()));
      };
      command.add(std::move(row));
    }
  }
  add_common_options(command, program.common, false);
  command.examples = {{"molecule 1bp2.pdb -o protein.off", "a smooth surface"},
                      {"molecule 1bp2.cif --kind ses --resolution 0.4 --chains A -o ses.ply",
                       "the solvent-excluded surface of one chain, fine"}};
  command.notes =
      "By default the first model's chains are taken, modified residues included, without ligands, ions and "
      "waters, and of alternate locations the one with the highest occupancy. --select takes what an "
      "expression of chain, resname, residue, name, element, polymer, ligand, ion, water, hydrogen, hetero, "
      "all, and, or, not says: \"chain A and not residue 10-20\".";
  command.details =
      "Radii are van der Waals radii of the elements (all-atom: Bondi 1964 and others, as gemmi has them) "
      "or, "
      "for 10 residues or more without hydrogens, united-atom (Tsai et al. 1999). A table of own radii has "
      "lines [RESIDUE] ATOM|ELEMENT RADIUS.";
  set_action(program, command, options, make);
}

}  // namespace morsel::tools
