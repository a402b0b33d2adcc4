// The only file with gemmi's headers, which take long to compile.
#include "morsel/core/atom_records.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <gemmi/cif.hpp>
#include <gemmi/elem.hpp>
#include <gemmi/pdb.hpp>
#include <gemmi/resinfo.hpp>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text_scanner.h"

namespace morsel::core {
namespace {

constexpr const char* kStep = "reading the atoms";

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

/// The whole text as a finite number.
std::optional<double> finite_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// What follows from element and residue name.
void complete(AtomRecord& record, gemmi::El element) {
  record.hydrogen = gemmi::is_hydrogen(element);
  record.atom.element = gemmi::element_name(element);
  // gemmi's table has two decimals, in single precision.
  record.atom.radius =
      element == gemmi::El::X ? 0 : std::round(100.0 * static_cast<double>(gemmi::vdw_radius(element))) / 100;
  const gemmi::ResidueInfo residue = gemmi::find_tabulated_residue(record.atom.residue);
  record.atom.water = residue.is_water();
  record.atom.polymer = residue.is_amino_acid() || residue.is_nucleic_acid();
}

bool has_record(std::string_view line, std::string_view name) {
  if (line.size() < name.size()) return false;
  for (std::size_t i = 0; i < name.size(); ++i)
    if ((line[i] >= 'a' && line[i] <= 'z' ? line[i] - 'a' + 'A' : line[i]) != name[i]) return false;
  return line.size() == name.size() || name.size() >= 6 || line[name.size()] == ' ' ||
         line[name.size()] == '\r';
}

/// The records of models and atoms alone, each on its own line and padded, the others blank: gemmi looks into
/// many more, and refuses a file for what is wrong in one of them. It takes a coordinate that is no number
/// for 0, so these are checked here.
std::string atom_lines(std::string_view bytes, const std::string& file, const Progress& progress) {
  constexpr std::size_t kWidth = 78;  // up to the element; a charge does not matter
  std::string lines;
  lines.reserve(bytes.size() + bytes.size() / 64);
  std::size_t number = 0;
  while (!bytes.empty()) {
    if (++number % (1 << 16) == 0) progress.throw_if_cancelled();
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    const auto fail = [&](const std::string& what) {
      throw BadInput(file + ", line " + std::to_string(number) + ": " + what);
    };
    if (number == 1 && line.starts_with("data_")) fail("this is a CIF file, not a PDB file: name it .cif");
    const bool atom = has_record(line, "ATOM") || has_record(line, "HETATM");
    if (atom) {
      if (line.size() < 54) fail("the record of an atom ends before its coordinates do, in column 54");
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view field = trimmed(line.substr(30 + 8 * static_cast<std::size_t>(axis), 8));
        if (!finite_number(field))
          fail("the coordinate " + std::string(1, "xyz"[axis]) + " of an atom is " + shown(field) +
               ", not a number");
      }
    }
    if (atom || has_record(line, "MODEL") || has_record(line, "ENDMDL") || has_record(line, "TER")) {
      const std::size_t first = lines.size();
      lines.append(line.substr(0, kWidth));
      std::replace_if(
          lines.begin() + static_cast<std::ptrdiff_t>(first), lines.end(),
          [](char c) { return c < ' ' || c > '~'; }, ' ');
      lines.append(kWidth - (lines.size() - first), ' ');
    } else if (has_record(line, "END")) {
      break;
    }
    lines += '\n';
  }
  return lines;
}

std::string sequence_id(const gemmi::SeqId& id) { return id.num ? id.str() : std::string(); }

/// gemmi's message, which may have several lines and begin with "FILE:LINE:COLUMN: ", as this project's are.
std::string reworded(std::string text, const std::string& file) {
  text.resize(std::min({text.size(), text.find('\n'), text.find(":\n")}));
  if (!text.starts_with(file + ":")) return file + " is damaged: " + text;
  text.erase(0, file.size() + 1);
  const std::size_t message = text.find(": ");
  return message == std::string::npos
             ? file + " is damaged: " + text
             : file + ", line " + text.substr(0, text.find(':')) + text.substr(message);
}

/// What `read` returns; what gemmi throws becomes BadInput.
template <class Read>
auto guarded(const std::string& file, const Read& read) {
  try {
    return read();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw BadInput(reworded(error.what(), file));
  }
}

/// The columns of _atom_site that are read; a ? stands before those that may be missing.
enum Column {
  kX,
  kY,
  kZ,
  kElement,
  kGroup,
  kLabelAtom,
  kAuthAtom,
  kLabelResidue,
  kAuthResidue,
  kLabelChain,
  kAuthChain,
  kLabelSequence,
  kAuthSequence,
  kInsertion,
  kAlternate,
  kOccupancy,
  kModel,
  kId
};
const std::vector<std::string> kColumns = {"Cartn_x",
                                           "Cartn_y",
                                           "Cartn_z",
                                           "type_symbol",
                                           "?group_PDB",
                                           "?label_atom_id",
                                           "?auth_atom_id",
                                           "?label_comp_id",
                                           "?auth_comp_id",
                                           "?label_asym_id",
                                           "?auth_asym_id",
                                           "?label_seq_id",
                                           "?auth_seq_id",
                                           "?pdbx_PDB_ins_code",
                                           "?label_alt_id",
                                           "?occupancy",
                                           "?pdbx_PDB_model_num",
                                           "?id"};

class AtomSites {
 public:
  AtomSites(gemmi::cif::Table& table, const std::string& file) : table_(table), file_(file) {}

  AtomRecords read(const Progress& progress) {
    AtomRecords all;
    all.records.reserve(table_.length());
    std::vector<std::string> models;  // in the order of the file
    for (std::size_t row = 0; row < table_.length(); ++row) {
      if (row % (1 << 16) == 0) progress.throw_if_cancelled();
      all.records.push_back(record(row));
      const std::string model = text(row, kModel);
      auto known = models.empty() || models.back() != model ? std::find(models.begin(), models.end(), model)
                                                            : std::prev(models.end());
      if (known == models.end()) known = models.insert(known, model);
      all.records.back().model = known - models.begin() + 1;
    }
    all.models = static_cast<std::int64_t>(models.size());
    return all;
  }

 private:
  /// The value without its quotes; empty if it is ., ? or missing.
  std::string text(std::size_t row, Column column) const {
    const auto values = table_[row];
    return values.has2(column) ? values.str(column) : std::string();
  }
  std::string first_of(std::size_t row, Column preferred, Column other) const {
    std::string value = text(row, preferred);
    return value.empty() ? text(row, other) : value;
  }

  double number(std::size_t row, Column column, std::optional<double> missing) const {
    std::string value = text(row, column);
    if (value.empty() && missing) return *missing;
    value.resize(std::min(value.size(), value.find('(')));  // a standard uncertainty follows
    if (const std::optional<double> parsed = finite_number(value)) return *parsed;
    throw BadInput(file_ + ", atom " + std::to_string(row + 1) +
                   " of _atom_site: " + kColumns[column].substr(kColumns[column][0] == '?' ? 1 : 0) + " is " +
                   shown(table_[row][column]) + ", not a number");
  }

  AtomRecord record(std::size_t row) const {
    AtomRecord record;
    Atom& atom = record.atom;
    atom.position = {number(row, kX, {}), number(row, kY, {}), number(row, kZ, {})};
    atom.name = first_of(row, kAuthAtom, kLabelAtom);
    atom.residue = first_of(row, kAuthResidue, kLabelResidue);
    atom.chain = first_of(row, kAuthChain, kLabelChain);
    atom.sequence_id = first_of(row, kAuthSequence, kLabelSequence) + text(row, kInsertion);
    atom.serial = static_cast<std::int64_t>(row) + 1;
    const std::string id = text(row, kId);
    std::from_chars(id.data(), id.data() + id.size(), atom.serial);
    atom.occupancy = number(row, kOccupancy, 1);
    const std::string alternate = text(row, kAlternate);
    atom.alternate = alternate.empty() ? '\0' : alternate[0];
    atom.hetero = text(row, kGroup) == "HETATM";
    complete(record, gemmi::find_element(text(row, kElement).c_str()));
    return record;
  }

  gemmi::cif::Table& table_;
  const std::string& file_;
};

/// Nothing if the block has no atoms.
std::optional<AtomRecords> block_atoms(gemmi::cif::Block& block, const std::string& file,
                                       const Progress& progress) {
  if (gemmi::cif::Table table = block.find("_atom_site.", kColumns); table.ok() && table.length() > 0)
    return AtomSites(table, file).read(progress);
  if (block.find_mmcif_category("_atom_site.").ok())
    throw BadInput(file + ": its _atom_site table lacks one of Cartn_x, Cartn_y, Cartn_z and type_symbol");
  return std::nullopt;
}

}  // namespace

AtomRecords read_pdb(std::string_view bytes, const std::string& file, const Progress& progress) {
  progress.update(kStep, 0);
  const std::string lines = atom_lines(bytes, file, progress);
  const gemmi::Structure structure =
      guarded(file, [&] { return gemmi::read_pdb_from_memory(lines.data(), lines.size(), file); });
  progress.update(kStep, 0.5);
  AtomRecords all;
  for (const gemmi::Model& model : structure.models) {
    const std::size_t before = all.records.size();
    for (const gemmi::Chain& chain : model.chains)
      for (const gemmi::Residue& residue : chain.residues)
        for (const gemmi::Atom& atom : residue.atoms) {
          AtomRecord& record = all.records.emplace_back();
          record.model = all.models + 1;
          record.atom.position = {atom.pos.x, atom.pos.y, atom.pos.z};
          record.atom.name = atom.name;
          record.atom.residue = residue.name;
          record.atom.chain = chain.name;
          record.atom.sequence_id = sequence_id(residue.seqid);
          record.atom.serial = atom.serial;
          record.atom.occupancy = atom.occ;
          record.atom.alternate = atom.altloc;
          record.atom.hetero = residue.het_flag == 'H';
          complete(record, atom.element);
        }
    if (all.records.size() > before) ++all.models;
  }
  return all;
}

AtomRecords read_mmcif(std::string_view bytes, const std::string& file, const Progress& progress) {
  progress.update(kStep, 0);
  return guarded(file, [&]() -> AtomRecords {
    gemmi::cif::Document document = gemmi::cif::read_memory(bytes.data(), bytes.size(), file.c_str());
    progress.update(kStep, 0.5);
    bool fractional = false;
    for (gemmi::cif::Block& block : document.blocks) {
      if (std::optional<AtomRecords> records = block_atoms(block, file, progress)) return *std::move(records);
      fractional = fractional || block.has_tag("_atom_site_fract_x");
    }
    if (fractional)
      throw BadInput(file + " is a CIF file with fractional coordinates; only mmCIF files are read");
    return {};
  });
}

}  // namespace morsel::core
