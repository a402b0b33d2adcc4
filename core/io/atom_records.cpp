#include "morsel/core/io/atom_records.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <map>
#include <new>
#include <numeric>
#include <optional>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/gemmi_bridge.h"
#include "morsel/core/parallel/interruptible.h"
#include "morsel/core/text/text_scanner.h"

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

/// Reads the records of models and atoms line by line; the others do not concern atoms, or are often wrong.
/// Fields are gemmi's to read; but it takes a coordinate that is no number for 0, so these are checked here.
/// Atoms of a residue come together, where its first atom is, as far as one stretch of a chain goes. O(n log
/// n).
class PdbReader {
 public:
  PdbReader(const std::string& file, const Progress& progress) : file_(file), progress_(progress) {}

  AtomRecords read(std::string_view bytes) {
    const std::size_t size = bytes.size();
    while (!bytes.empty()) {
      if (++line_number_ % (1 << 16) == 0)
        progress_.update(kStep, 1 - static_cast<double>(bytes.size()) / static_cast<double>(size));
      const std::size_t end = std::min(bytes.find('\n'), bytes.size());
      const std::string_view line = bytes.substr(0, end);
      bytes.remove_prefix(std::min(end + 1, bytes.size()));
      if (line_number_ == 1 && line.starts_with("data_"))
        fail("this is a CIF file, not a PDB file: name it .cif");
      if (has_record(line, "ATOM") || has_record(line, "HETATM"))
        read_atom(line);
      else if (has_record(line, "MODEL"))
        begin_model(line);
      else if (has_record(line, "ENDMDL"))
        end_model();
      else if (has_record(line, "END"))
        break;
    }
    end_stretch();
    AtomRecords all;
    for (std::vector<AtomRecord>& atoms : models_) {
      if (atoms.empty()) continue;
      ++all.models;
      for (AtomRecord& record : atoms) {
        record.model = all.models;
        all.records.push_back(std::move(record));
      }
    }
    return all;
  }

 private:
  static constexpr std::size_t kNoModel = ~std::size_t{0};

  /// What all atoms of a residue have from its first one.
  struct FirstAtom {
    std::string sequence_id;
    bool hetero;
  };

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(file_, line_number_, what); }

  /// A line as gemmi's functions expect it: printable, and padded up to the element; a charge does not
  /// matter.
  static gemmi_bridge::PdbLine padded(std::string_view line) {
    gemmi_bridge::PdbLine result;
    result.fill(' ');
    line = line.substr(0, result.size() - 1);
    std::transform(line.begin(), line.end(), result.begin(),
                   [](char c) { return c < ' ' || c > '~' ? ' ' : c; });
    result.back() = '\0';
    return result;
  }

  void begin_model(std::string_view line) {
    if (model_ != kNoModel && in_stretch_) fail("a model begins before the one before it has ended (ENDMDL)");
    const int number = gemmi_bridge::pdb_model_number(padded(line));
    model_ = model_of_number_.emplace(number, models_.size()).first->second;
    if (model_ == models_.size()) models_.emplace_back();
    if (!models_[model_].empty()) fail("there are two models of the number " + std::to_string(number));
    end_stretch();
  }

  void end_model() {
    end_stretch();
    model_ = kNoModel;
  }

  void read_atom(std::string_view line) {
    if (line.size() < 54) fail("the record of an atom ends before its coordinates do, in column 54");
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view field = trimmed(line.substr(30 + 8 * static_cast<std::size_t>(axis), 8));
      if (!finite_number(field))
        fail("the coordinate " + std::string(1, "xyz"[axis]) + " of an atom is " + shown(field) +
             ", not a number");
    }
    gemmi_bridge::PdbAtom from = gemmi_bridge::read_pdb_atom(padded(line));
    if (!in_stretch_ || from.chain != chain_) begin_stretch(from.chain);
    const std::size_t residue = residue_of(from);
    AtomRecord& record = models_[model_].emplace_back();
    record.atom.position = {from.x, from.y, from.z};
    record.atom.name = std::move(from.name);
    record.atom.residue = std::move(from.residue.name);
    record.atom.chain = std::move(from.chain);
    record.atom.sequence_id = of_residue_[residue].sequence_id;
    record.atom.serial = from.serial;
    record.atom.occupancy = from.occupancy;
    record.atom.alternate = from.alternate;
    record.atom.hetero = of_residue_[residue].hetero;
    complete(record, from.element);
    residues_.push_back(residue);
  }

  /// A number within the stretch.
  std::size_t residue_of(const gemmi_bridge::PdbAtom& atom) {
    if (!residues_.empty() && atom.residue == last_residue_) return residues_.back();
    last_residue_ = atom.residue;
    const auto [known, is_new] = number_of_residue_.emplace(atom.residue, of_residue_.size());
    if (is_new) of_residue_.push_back({atom.sequence_id, atom.hetero});
    return known->second;
  }

  void begin_stretch(const std::string& chain) {
    end_stretch();
    if (model_ == kNoModel) {  // there is one model, or frames that end with ENDMDL
      model_ = models_.size();
      if (!model_of_number_.emplace(static_cast<int>(model_) + 1, model_).second)
        fail("there is an atom between two models");
      models_.emplace_back();
    }
    in_stretch_ = true;
    chain_ = chain;
  }

  void end_stretch() {
    if (!std::is_sorted(residues_.begin(), residues_.end())) {
      std::vector<AtomRecord>& atoms = models_[model_];
      const std::size_t first = atoms.size() - residues_.size();
      std::vector<std::size_t> order(residues_.size());
      std::iota(order.begin(), order.end(), first);
      std::stable_sort(order.begin(), order.end(), interruptible([&](std::size_t a, std::size_t b) {
                         return residues_[a - first] < residues_[b - first];
                       }));
      std::vector<AtomRecord> sorted;
      sorted.reserve(order.size());
      for (const std::size_t i : order) sorted.push_back(std::move(atoms[i]));
      std::move(sorted.begin(), sorted.end(), atoms.begin() + static_cast<std::ptrdiff_t>(first));
    }
    in_stretch_ = false;
    residues_.clear();
    number_of_residue_.clear();
    of_residue_.clear();
  }

  const std::string& file_;
  const Progress& progress_;
  std::size_t line_number_ = 0;
  std::vector<std::vector<AtomRecord>> models_;
  std::map<int, std::size_t> model_of_number_;
  std::size_t model_ = kNoModel;
  // The stretch of a chain: what follows one another in a model with the same chain name.
  bool in_stretch_ = false;
  std::string chain_;
  std::vector<std::size_t> residues_;  // per atom, numbered as they first appear
  std::map<gemmi_bridge::PdbResidue, std::size_t> number_of_residue_;
  gemmi_bridge::PdbResidue last_residue_;
  std::vector<FirstAtom> of_residue_;
};

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
    std::map<std::string, std::int64_t> models;  // numbered in the order of the file
    for (std::size_t row = 0; row < cif_.rows(); ++row) {
      if (row % (1 << 16) == 0) progress.throw_if_cancelled();
      all.records.push_back(record(row));
      const auto number = static_cast<std::int64_t>(models.size()) + 1;
      all.records.back().model = models.try_emplace(text(row, kModel), number).first->second;
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

void require_molecules(std::string_view) {}

AtomRecords read_pdb(std::string_view bytes, const std::string& file, const Progress& progress) {
  progress.update(kStep, 0);
  return guarded(file, [&] { return PdbReader(file, progress).read(bytes); });
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
