// The only file with gemmi's headers, which take long to compile; in C++17.
#include "morsel/core/io/gemmi_bridge.h"

#include <algorithm>
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

namespace {

/// A residue without hydrogens that weighs as much as an element is that element.
std::string element_of_weight(const gemmi::ResidueInfo& info) {
  if (!info.found() || info.hydrogen_count != 0) return {};
  for (int i = 1; i < static_cast<int>(gemmi::El::END); ++i) {
    const gemmi::Element element(i);
    const bool noble = i == 2 || i == 10 || i == 18 || i == 36 || i == 54 || i == 86;
    if (!noble && std::abs(element.weight() - static_cast<double>(info.weight)) < 0.02) return element.name();
  }
  return {};
}

}  // namespace

Residue find_residue(const std::string& name) {
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(name);
  Residue residue;
  residue.known = info.found();
  residue.water = info.is_water();
  residue.amino_acid = info.is_amino_acid();
  residue.nucleotide = info.is_nucleic_acid();
  residue.standard =
      (residue.amino_acid || residue.nucleotide) && info.is_standard() && info.one_letter_code != ' ';
  residue.ion = element_of_weight(info);
  return residue;
}

std::string element_by_columns(const std::array<char, 4>& name) {
  // By gemmi's rules (read_pdb_from_stream(), where they cannot be called).
  const std::array<char, 5> text = {name[0], name[1], name[2], name[3], '\0'};
  gemmi::El element = gemmi::El::X;
  if (gemmi::is_digit(text[0]))
    element = gemmi::impl::find_single_letter_element(text[1] & ~0x20);  // "1HB "
  else if (gemmi::is_digit(text[1]))
    element = gemmi::impl::find_single_letter_element(text[0] & ~0x20);  // "C210"
  else
    element = gemmi::find_element(text.data());
  return gemmi::element_name(element);
}

PdbAtom read_pdb_atom(const PdbLine& line, bool long_residue_name) {
  namespace pdb = gemmi::pdb_impl;
  const char* const at = line.data();
  const gemmi::ResidueId id = pdb::read_res_id(at + 22, at + 17);
  PdbAtom atom;
  atom.residue = {*id.seqid.num, static_cast<char>(id.seqid.icode | 0x20), pdb::read_string(at + 72, 4),
                  long_residue_name ? pdb::read_string(at + 17, 4) : id.name};
  atom.sequence_id = id.seqid.num ? id.seqid.str() : std::string();
  atom.chain = long_residue_name ? pdb::read_string(at + 21, 1) : pdb::read_string(at + 20, 2);
  atom.serial = pdb::read_serial(at + 6);
  atom.name = pdb::read_string(at + 12, 4);
  atom.alternate = pdb::read_altloc(at[16]);
  atom.x = pdb::read_double(at + 30, 8);
  atom.y = pdb::read_double(at + 38, 8);
  atom.z = pdb::read_double(at + 46, 8);
  const bool has_occupancy = !pdb::read_string(at + 54, 6).empty();
  atom.occupancy = has_occupancy ? static_cast<double>(static_cast<float>(pdb::read_double(at + 54, 6))) : 1;
  std::copy_n(at + 12, 4, atom.columns.begin());
  for (const char c : {at[76], at[77]})
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) atom.symbol += c;
  atom.hetero = (at[0] & ~0x20) == 'H';
  return atom;
}

int pdb_model_number(const PdbLine& line) { return gemmi::pdb_impl::read_int(line.data() + 10, 4); }

struct CifFile::Content {
  gemmi::cif::Document document;
  gemmi::cif::Block* block = nullptr;
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
      content_->block = &block;
      content_->table.emplace(std::move(table));
      return Found::yes;
    }
    if (block.find_mmcif_category(category).ok()) return Found::without_columns;
  }
  return Found::no;
}

std::optional<std::string> CifFile::value_of(const std::string& tag) const {
  for (gemmi::cif::Block& block : content_->document.blocks) {
    const gemmi::cif::Column column = block.find_values(tag);
    if (column.length() > 0) return column.str(0);
  }
  return std::nullopt;
}

std::vector<std::vector<std::string>> CifFile::rows_of(const std::string& category,
                                                       const std::vector<std::string>& columns) {
  std::vector<std::vector<std::string>> rows;
  if (content_->block == nullptr) return rows;
  gemmi::cif::Table table = content_->block->find(category, columns);
  if (!table.ok()) return rows;
  rows.reserve(table.length());
  for (const auto& row : table) {
    std::vector<std::string>& values = rows.emplace_back(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (row.has2(i)) values[i] = row.str(static_cast<int>(i));
  }
  return rows;
}

std::size_t CifFile::rows() const { return content_->table ? content_->table->length() : 0; }

std::string CifFile::text(std::size_t row, std::size_t column) const {
  const auto values = content_->table.value()[static_cast<int>(row)];
  return values.has2(column) ? values.str(static_cast<int>(column)) : std::string();
}

}  // namespace morsel::core::gemmi_bridge
