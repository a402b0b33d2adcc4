// The only file with gemmi's headers, which take long to compile; in C++17.
#include "morsel/core/gemmi_bridge.h"

#include <cmath>
#include <gemmi/cif.hpp>
#include <gemmi/elem.hpp>
#include <gemmi/pdb.hpp>
#include <gemmi/resinfo.hpp>
#include <optional>
#include <utility>

namespace morsel::core::gemmi_bridge {

Element find_element(const std::string& symbol) {
  const gemmi::El element = gemmi::find_element(symbol.c_str());
  // gemmi's table has two decimals, in single precision.
  const double radius = std::round(100.0 * static_cast<double>(gemmi::vdw_radius(element))) / 100;
  return {gemmi::element_name(element), element == gemmi::El::X ? 0 : radius, gemmi::is_hydrogen(element)};
}

Residue find_residue(const std::string& name) {
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(name);
  return {info.is_water(), info.is_amino_acid() || info.is_nucleic_acid()};
}

std::vector<std::vector<PdbAtom>> read_pdb(std::string_view text, const std::string& file) {
  const gemmi::Structure structure = gemmi::read_pdb_from_memory(text.data(), text.size(), file);
  std::vector<std::vector<PdbAtom>> models;
  for (const gemmi::Model& model : structure.models) {
    std::vector<PdbAtom> atoms;
    for (const gemmi::Chain& chain : model.chains)
      for (const gemmi::Residue& residue : chain.residues)
        for (const gemmi::Atom& atom : residue.atoms)
          atoms.push_back({atom.pos.x, atom.pos.y, atom.pos.z, atom.element.name(), atom.name, residue.name,
                           chain.name, residue.seqid.num ? residue.seqid.str() : std::string(), atom.serial,
                           static_cast<double>(atom.occ), atom.altloc, residue.het_flag == 'H'});
    if (!atoms.empty()) models.push_back(std::move(atoms));
  }
  return models;
}

struct CifFile::Content {
  gemmi::cif::Document document;
  std::optional<gemmi::cif::Table> table;
};

CifFile::CifFile(std::string_view text, const std::string& file) : content_(std::make_unique<Content>()) {
  content_->document = gemmi::cif::read_memory(text.data(), text.size(), file.c_str());
}
CifFile::~CifFile() = default;

CifFile::Found CifFile::find(const std::string& category, const std::vector<std::string>& columns) {
  for (gemmi::cif::Block& block : content_->document.blocks) {
    gemmi::cif::Table table = block.find(category, columns);
    if (table.ok() && table.length() > 0) {
      content_->table.emplace(std::move(table));
      return Found::yes;
    }
    if (block.find_mmcif_category(category).ok()) return Found::without_columns;
  }
  return Found::no;
}

bool CifFile::has_tag(const std::string& tag) const {
  for (const gemmi::cif::Block& block : content_->document.blocks)
    if (block.has_tag(tag)) return true;
  return false;
}

std::size_t CifFile::rows() const { return content_->table ? content_->table->length() : 0; }

std::string CifFile::text(std::size_t row, std::size_t column) const {
  const auto values = content_->table.value()[static_cast<int>(row)];
  return values.has2(column) ? values.str(static_cast<int>(column)) : std::string();
}

}  // namespace morsel::core::gemmi_bridge
