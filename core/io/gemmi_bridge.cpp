// The only file with gemmi's headers, which take long to compile; in C++17.
#include "morsel/core/io/gemmi_bridge.h"

#include <cctype>
#include <cmath>
#include <gemmi/cif.hpp>
#include <gemmi/elem.hpp>
#include <gemmi/pdb.hpp>
#include <gemmi/resinfo.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
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

namespace {

/// By gemmi's rules (read_pdb_from_stream(), where they cannot be called).
gemmi::El element_of(const char* line) {
  if (std::isalpha(static_cast<unsigned char>(line[76])) != 0 ||
      std::isalpha(static_cast<unsigned char>(line[77])) != 0)
    return gemmi::find_element(line + 76);
  if (gemmi::alpha_up(line[12]) == 'H' && line[15] != ' ')
    return gemmi::El::H;  // HXXX is ambiguous, but most often H
  if (gemmi::is_digit(line[12])) return gemmi::impl::find_single_letter_element(line[13]);  // "1HB "
  if (gemmi::is_digit(line[13])) return gemmi::impl::find_single_letter_element(line[12]);  // "C210"
  return gemmi::find_element(line + 12);
}

}  // namespace

PdbAtom read_pdb_atom(const PdbLine& line) {
  namespace pdb = gemmi::pdb_impl;
  const char* const at = line.data();
  const gemmi::ResidueId id = pdb::read_res_id(at + 22, at + 17);
  PdbAtom atom;
  atom.residue = {*id.seqid.num, static_cast<char>(id.seqid.icode | 0x20), pdb::read_string(at + 72, 4),
                  id.name};
  atom.sequence_id = id.seqid.num ? id.seqid.str() : std::string();
  atom.chain = pdb::read_string(at + 20, 2);
  atom.serial = pdb::read_serial(at + 6);
  atom.name = pdb::read_string(at + 12, 4);
  atom.alternate = pdb::read_altloc(at[16]);
  atom.x = pdb::read_double(at + 30, 8);
  atom.y = pdb::read_double(at + 38, 8);
  atom.z = pdb::read_double(at + 46, 8);
  atom.occupancy = static_cast<double>(static_cast<float>(pdb::read_double(at + 54, 6)));
  atom.element = gemmi::element_name(element_of(at));
  atom.hetero = (at[0] & ~0x20) == 'H';
  return atom;
}

int pdb_model_number(const PdbLine& line) { return gemmi::pdb_impl::read_int(line.data() + 10, 4); }

struct CifFile::Content {
  gemmi::cif::Document document;
  std::optional<gemmi::cif::Table> table;
};

namespace {

/// As gemmi's check_for_duplicates(), whose time is quadratic in the number of blocks: it clears a large hash
/// table for each.
void refuse_duplicates(const gemmi::cif::Document& document) {
  std::set<std::string> blocks;
  for (const gemmi::cif::Block& block : document.blocks) {
    if (!blocks.insert(gemmi::to_lower(block.name)).second && !block.name.empty())
      throw std::runtime_error("duplicate block name: " + block.name);
    std::set<std::string> tags, frames;
    for (const gemmi::cif::Item& item : block.items) {
      const auto add = [&](std::set<std::string>& names, const std::string& name, const char* what) {
        if (!names.insert(gemmi::to_lower(name)).second)
          gemmi::cif::cif_fail(document.source, block, item, what + name);
      };
      if (item.type == gemmi::cif::ItemType::Pair) add(tags, item.pair[0], "duplicate tag ");
      if (item.type == gemmi::cif::ItemType::Loop)
        for (const std::string& tag : item.loop.tags) add(tags, tag, "duplicate tag ");
      if (item.type == gemmi::cif::ItemType::Frame) add(frames, item.frame.name, "duplicate save_");
    }
  }
}

}  // namespace

CifFile::CifFile(std::string_view text, const std::string& file) : content_(std::make_unique<Content>()) {
  tao::pegtl::memory_input<> input(text.data(), text.size(), file.c_str());
  content_->document.source = input.source();
  gemmi::cif::parse_input(content_->document, input);
  gemmi::cif::check_for_missing_values(content_->document);
  refuse_duplicates(content_->document);
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
