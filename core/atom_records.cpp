#include "morsel/core/atom_records.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/gemmi_bridge.h"
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

/// Adds what follows from the names of element and residue.
void complete(AtomRecord& record, const std::string& symbol) {
  gemmi_bridge::Element element = gemmi_bridge::find_element(symbol);
  record.hydrogen = element.hydrogen;
  record.atom.element = std::move(element.symbol);
  record.atom.radius = element.radius;
  const gemmi_bridge::Residue residue = gemmi_bridge::find_residue(record.atom.residue);
  record.atom.water = residue.water;
  record.atom.polymer = residue.polymer;
}

bool has_record(std::string_view line, std::string_view name) {
  if (line.size() < name.size()) return false;
  for (std::size_t i = 0; i < name.size(); ++i)
    if ((line[i] >= 'a' && line[i] <= 'z' ? line[i] - 'a' + 'A' : line[i]) != name[i]) return false;
  return line.size() == name.size() || name.size() >= 6 || line[name.size()] == ' ' ||
         line[name.size()] == '\r';
}

[[noreturn]] void fail_at_line(const std::string& file, std::size_t line, const std::string& what) {
  throw BadInput(file + ", line " + std::to_string(line) + ": " + what);
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
    const auto fail = [&](const std::string& what) { fail_at_line(file, number, what); };
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
  AtomSites(const gemmi_bridge::CifFile& cif, const std::string& file) : cif_(cif), file_(file) {}

  AtomRecords read(const Progress& progress) {
    AtomRecords all;
    all.records.reserve(cif_.rows());
    std::vector<std::string> models;  // in the order of the file
    for (std::size_t row = 0; row < cif_.rows(); ++row) {
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
  std::string text(std::size_t row, Column column) const { return cif_.text(row, column); }
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
                   shown(text(row, column)) + ", not a number");
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
    complete(record, text(row, kElement));
    return record;
  }

  const gemmi_bridge::CifFile& cif_;
  const std::string& file_;
};

}  // namespace

AtomRecords read_pdb(std::string_view bytes, const std::string& file, const Progress& progress) {
  progress.update(kStep, 0);
  const std::string lines = atom_lines(bytes, file, progress);
  const auto models = guarded(file, [&] { return gemmi_bridge::read_pdb(lines, file); });
  progress.update(kStep, 0.5);
  AtomRecords all;
  for (const std::vector<gemmi_bridge::PdbAtom>& atoms : models) {
    ++all.models;
    for (const gemmi_bridge::PdbAtom& from : atoms) {
      AtomRecord& record = all.records.emplace_back();
      record.model = all.models;
      record.atom.position = {from.x, from.y, from.z};
      record.atom.name = from.name;
      record.atom.residue = from.residue;
      record.atom.chain = from.chain;
      record.atom.sequence_id = from.sequence_id;
      record.atom.serial = from.serial;
      record.atom.occupancy = from.occupancy;
      record.atom.alternate = from.alternate;
      record.atom.hetero = from.hetero;
      complete(record, from.element);
    }
  }
  return all;
}

AtomRecords read_mmcif(std::string_view bytes, const std::string& file, const Progress& progress) {
  progress.update(kStep, 0);
  return guarded(file, [&]() -> AtomRecords {
    gemmi_bridge::CifFile cif(bytes, file);
    progress.update(kStep, 0.5);
    switch (cif.find("_atom_site.", kColumns)) {
      case gemmi_bridge::CifFile::Found::yes:
        return AtomSites(cif, file).read(progress);
      case gemmi_bridge::CifFile::Found::without_columns:
        throw BadInput(file +
                       ": its _atom_site table lacks one of Cartn_x, Cartn_y, Cartn_z and type_symbol");
      case gemmi_bridge::CifFile::Found::no:
        break;
    }
    if (cif.has_tag("_atom_site_fract_x"))
      throw BadInput(file + " is a CIF file with fractional coordinates; only mmCIF files are read");
    return {};
  });
}

}  // namespace morsel::core
