#include "morsel/core/io/atom_records.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <map>
#include <new>
#include <numeric>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/atom_roles.h"
#include "morsel/core/io/gemmi_bridge.h"
#include "morsel/core/io/residue_names.h"
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

/// The words of a line from a column on.
template <class Take>
void for_each_word(std::string_view line, std::size_t column, const Take& take) {
  line = trimmed(line.substr(std::min(column, line.size())));
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(' '), line.size());
    take(line.substr(0, end));
    line = trimmed(line.substr(end));
  }
}

/// Reads the records of one model line by line; records of other kinds, but for those of the sequence, do not
/// concern atoms, or are often wrong. Fields are gemmi's to read; but it takes a coordinate that is no number
/// for 0, so these are checked here. Atoms of a residue come together, where its first atom is, as far as one
/// stretch of a chain goes. O(n log n).
class PdbReader {
 public:
  PdbReader(const std::string& file, const Progress& progress, std::int64_t model)
      : file_(file), progress_(progress), wanted_(model) {}

  AtomRecords read(std::string_view bytes) {
    has_long_chain_names_ = find_long_chain_names(bytes);
    for_each_line(bytes, 0.2, 0.8, [&](std::string_view line) {
      if (line_number_ == 1 && line.starts_with("data_"))
        fail("this is a CIF file, not a PDB file: name it .cif");
      if (is_atom(line))
        take_atom(line);
      else if (has_record(line, "MODEL"))
        begin_model(line);
      else if (has_record(line, "ENDMDL"))
        end_model();
      else if (has_record(line, "SEQRES"))
        for_each_word(line, 19, [&](std::string_view name) { add_to_sequence(line, 10, name); });
      else if (has_record(line, "MODRES") && line.size() > 16)
        add_to_sequence(line, 15, trimmed(line.substr(12, 3)));
      return !has_record(line, "END");
    });
    end_stretch();
    for (AtomRecord& record : all_.records) record.in_sequence = is_in_sequence(record.atom);
    return std::move(all_);
  }

 private:
  /// What all atoms of a residue have from its first one.
  struct FirstAtom {
    std::string sequence_id;
    bool hetero;
  };

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(file_, line_number_, what); }
  void warn(const std::string& what) {
    all_.warnings.push_back("line " + std::to_string(line_number_) + ": " + what);
  }

  static bool is_atom(std::string_view line) {
    return has_record(line, "ATOM") || has_record(line, "HETATM");
  }

  /// Until `take` returns false. Reports progress from `first` on, a `share` of all work.
  template <class Take>
  void for_each_line(std::string_view bytes, double first, double share, const Take& take) {
    const auto size = static_cast<double>(bytes.size());
    line_number_ = 0;
    while (!bytes.empty()) {
      if (++line_number_ % (1 << 16) == 0)
        progress_.update(kStep, first + share * (1 - static_cast<double>(bytes.size()) / size));
      const std::size_t end = std::min(bytes.find('\n'), bytes.size());
      const std::string_view line = bytes.substr(0, end);
      bytes.remove_prefix(std::min(end + 1, bytes.size()));
      if (!take(line)) return;
    }
  }

  /// Column 21 is the fourth of a residue's name (TIP3, POPC; CHARMM, GROMACS) or the first of a chain's
  /// (AA; large structures). It is a chain's where it follows an amino acid or nucleotide of the PDB without
  /// being the end of another known name, as in "ALAA".
  bool find_long_chain_names(std::string_view bytes) {
    bool found = false;
    std::string last;
    for_each_line(bytes, 0, 0.2, [&](std::string_view line) {
      if (!is_atom(line) || line.size() < 54 || line[20] <= ' ' || line.substr(17, 4) == last)
        return !has_record(line, "END");
      last = line.substr(17, 4);
      const gemmi_bridge::Residue residue =
          gemmi_bridge::find_residue(in_capitals(trimmed(last.substr(0, 3))));
      found = (residue.amino_acid || residue.nucleotide) &&
              find_simulation_name(in_capitals(last)).residue_class == ResidueClass::unknown;
      return !found;
    });
    return found;
  }

  /// Whether the residue's name is in columns 18 to 21.
  bool has_long_residue_name(std::string_view line) const {
    return !has_long_chain_names_ && line[17] > ' ' && line[18] > ' ' && line[19] > ' ' && line[20] > ' ';
  }

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

  /// `column`: of the chain's two characters.
  void add_to_sequence(std::string_view line, std::size_t column, std::string_view residue) {
    sequence_.emplace(trimmed(line.substr(column, 2)), in_capitals(residue));
  }

  bool is_in_sequence(const Atom& atom) {
    if (sequence_.empty()) return false;
    if (atom.chain != last_asked_.first || atom.residue != last_asked_.second) {
      last_asked_ = {atom.chain, atom.residue};
      last_answer_ = sequence_.contains({atom.chain, in_capitals(atom.residue)});
    }
    return last_answer_;
  }

  void begin_model(std::string_view line) {
    if (in_model_ && has_atoms_) warn("a model begins before the one before it has ended (ENDMDL)");
    end_model();
    in_model_ = true;
    number_ = gemmi_bridge::pdb_model_number(padded(line));
    if (const bool is_new = numbers_.insert(*number_).second; !is_new && !has_told_number_) {
      has_told_number_ = true;
      warn("another model has the number " + std::to_string(*number_) +
           ", too; models are counted in the order of the file");
    }
  }

  void end_model() {
    end_stretch();
    in_model_ = has_atoms_ = false;
  }

  void take_atom(std::string_view line) {
    if (!has_atoms_) {  // there is one model, or frames that end with ENDMDL
      if (!in_model_ && number_ && !has_told_outside_) {
        has_told_outside_ = true;
        warn("an atom is in no model, where others are; such atoms are a model of their own");
      }
      in_model_ = has_atoms_ = true;
      ++all_.models;
    }
    if (all_.models == wanted_) read_atom(line);
  }

  void read_atom(std::string_view line) {
    if (line.size() < 54) fail("the record of an atom ends before its coordinates do, in column 54");
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view field = trimmed(line.substr(30 + 8 * static_cast<std::size_t>(axis), 8));
      if (!finite_number(field))
        fail("the coordinate " + std::string(1, "xyz"[axis]) + " of an atom is " + shown(field) +
             ", not a number");
    }
    gemmi_bridge::PdbAtom from = gemmi_bridge::read_pdb_atom(padded(line), has_long_residue_name(line));
    if (!in_stretch_ || from.chain != chain_) {
      end_stretch();
      in_stretch_ = true;
      chain_ = from.chain;
    }
    const std::size_t residue = residue_of(from);
    AtomRecord& record = all_.records.emplace_back();
    record.atom.position = {from.x, from.y, from.z};
    record.atom.name = std::move(from.name);
    record.atom.residue = std::move(from.residue.name);
    record.atom.chain = std::move(from.chain);
    record.atom.sequence_id = of_residue_[residue].sequence_id;
    record.atom.serial = from.serial;
    record.atom.occupancy = from.occupancy;
    record.atom.alternate = from.alternate;
    record.atom.hetero = of_residue_[residue].hetero;
    record.symbol = std::move(from.symbol);
    record.columns = from.columns;
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

  void end_stretch() {
    if (!std::is_sorted(residues_.begin(), residues_.end())) {
      std::vector<AtomRecord>& atoms = all_.records;
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
  const std::int64_t wanted_;
  AtomRecords all_;
  std::size_t line_number_ = 0;
  bool has_long_chain_names_ = false;
  std::set<std::pair<std::string, std::string>> sequence_;  // chain, residue
  std::pair<std::string, std::string> last_asked_;
  bool last_answer_ = false;
  // Of models.
  std::optional<int> number_;  // of the last record MODEL
  std::set<int> numbers_;
  bool in_model_ = false;
  bool has_atoms_ = false;  // the model that is being read
  bool has_told_number_ = false;
  bool has_told_outside_ = false;
  // The stretch of a chain: what follows one another in a model with the same chain name.
  bool in_stretch_ = false;
  std::string chain_;
  std::vector<std::size_t> residues_;  // per atom, numbered as they first appear
  std::map<gemmi_bridge::PdbResidue, std::size_t> number_of_residue_;
  gemmi_bridge::PdbResidue last_residue_;
  std::vector<FirstAtom> of_residue_;
};

/// Reads lines of words: ATOM or HETATM, number, atom, residue, the chain if it is there, number of the
/// residue, x, y, z, charge, radius.
class PqrReader {
 public:
  PqrReader(const std::string& file, const Progress& progress) : file_(file), progress_(progress) {}

  AtomRecords read(std::string_view bytes) {
    TextScanner text(bytes, file_, {.comment = '#'}, progress_);
    AtomRecords all;
    while (text.next_line()) {
      words_.clear();
      for (std::string_view word = text.word(); !word.empty(); word = text.word()) words_.emplace_back(word);
      const std::string kind = in_capitals(words_[0].substr(0, 6));
      if (kind == "END") break;
      if (kind == "ENDMDL" && !all.records.empty()) break;
      if (!split_serial(kind)) continue;
      all.models = 1;
      all.records.push_back(record(text));
    }
    return all;
  }

 private:
  /// Whether it is an atom, whose kind and number may have grown together, as in "HETATM10000".
  bool split_serial(const std::string& kind) {
    const std::size_t length = kind.starts_with("ATOM") ? 4 : kind == "HETATM" ? 6 : 0;
    if (length == 0) return false;
    const std::string_view rest = words_[0].substr(length);
    if (rest.empty()) return true;
    if (rest[0] < '0' || rest[0] > '9') return false;
    words_.insert(words_.begin() + 1, rest);
    words_[0] = words_[0].substr(0, length);
    return true;
  }

  AtomRecord record(const TextScanner& text) const {
    if (words_.size() < 10 || words_.size() > 11)
      text.fail(
          "an atom of a PQR file has 10 words (ATOM, number, atom, residue, number, x, y, z, charge, "
          "radius) or 11 with a chain before the second number, not " +
          std::to_string(words_.size()));
    AtomRecord record;
    Atom& atom = record.atom;
    const auto number = [&](std::size_t from_end, const char* what) {
      const std::string_view word = words_[words_.size() - from_end];
      if (const std::optional<double> parsed = finite_number(word)) return *parsed;
      text.fail(std::string(what) + " of an atom is " + shown(word) + ", not a number");
    };
    atom.position = {number(5, "the coordinate x"), number(4, "the coordinate y"),
                     number(3, "the coordinate z")};
    atom.charge = number(2, "the charge");
    record.own_radius = number(1, "the radius");
    if (record.own_radius < 0) text.fail("the radius of an atom is negative: " + shown(words_.back()));
    std::from_chars(words_[1].data(), words_[1].data() + words_[1].size(), atom.serial);
    atom.name = words_[2];
    atom.residue = words_[3];
    if (words_.size() == 11) atom.chain = words_[4];
    atom.sequence_id = words_[words_.size() - 6];
    atom.hetero = words_[0].size() == 6;
    return record;
  }

  const std::string& file_;
  const Progress& progress_;
  std::vector<std::string_view> words_;
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
  kEntity,
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
                                           "?type_symbol",
                                           "?group_PDB",
                                           "?label_entity_id",
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

/// The residues of chains, as a file's tables of entities give them.
class CifSequence {
 public:
  explicit CifSequence(gemmi_bridge::CifFile& cif) {
    for (const auto& row : cif.rows_of("_entity.", {"id", "type"}))
      if (in_capitals(row[1]) == "POLYMER") entities_.insert(row[0]);
    for (const auto& row : cif.rows_of("_entity_poly.", {"entity_id"})) entities_.insert(row[0]);
    for (const auto& row : cif.rows_of("_entity_poly_seq.", {"entity_id", "mon_id"})) {
      entities_.insert(row[0]);
      residues_.insert(in_capitals(row[1]));
    }
    for (const auto& row : cif.rows_of("_struct_asym.", {"id", "entity_id"})) entity_of_[row[0]] = row[1];
  }

  /// Of an atom that says so little of its entity, the residue's name tells.
  bool has(std::string entity, const std::string& chain, const std::string& residue) const {
    if (entities_.empty()) return false;
    if (entity.empty())
      if (const auto known = entity_of_.find(chain); known != entity_of_.end()) entity = known->second;
    return entity.empty() ? residues_.contains(in_capitals(residue)) : entities_.contains(entity);
  }

 private:
  std::set<std::string> entities_, residues_;
  std::map<std::string, std::string> entity_of_;  // by chain (label_asym_id)
};

class AtomSites {
 public:
  AtomSites(gemmi_bridge::CifFile& cif, const std::string& file) : cif_(cif), file_(file), sequence_(cif) {}

  AtomRecords read(std::int64_t wanted, const Progress& progress) {
    AtomRecords all;
    std::map<std::string, std::int64_t> models;  // numbered in the order of the file
    for (std::size_t row = 0; row < cif_.rows(); ++row) {
      if (row % (1 << 16) == 0) progress.throw_if_cancelled();
      const auto number = static_cast<std::int64_t>(models.size()) + 1;
      if (models.try_emplace(text(row, kModel), number).first->second == wanted)
        all.records.push_back(record(row));
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
    record.symbol = text(row, kElement);
    record.in_sequence = sequence_.has(text(row, kEntity), text(row, kLabelChain), atom.residue);
    return record;
  }

  const gemmi_bridge::CifFile& cif_;
  const std::string& file_;
  CifSequence sequence_;
};

}  // namespace

void require_molecules(std::string_view) {}

AtomRecords read_pdb(std::string_view bytes, const std::string& file, const Progress& progress,
                     std::int64_t model) {
  progress.update(kStep, 0);
  return guarded(file, [&] {
    AtomRecords all = PdbReader(file, progress, model).read(bytes);
    identify_atoms(all);
    return all;
  });
}

AtomRecords read_mmcif(std::string_view bytes, const std::string& file, const Progress& progress,
                       std::int64_t model) {
  progress.update(kStep, 0);
  return guarded(file, [&]() -> AtomRecords {
    gemmi_bridge::CifFile cif(bytes, file);
    progress.update(kStep, 0.5);
    switch (cif.find("_atom_site.", kColumns)) {
      case gemmi_bridge::CifFile::Found::yes: {
        AtomRecords all = AtomSites(cif, file).read(model, progress);
        identify_atoms(all);
        return all;
      }
      case gemmi_bridge::CifFile::Found::without_columns:
        throw BadInput(file + ": its _atom_site table lacks one of Cartn_x, Cartn_y and Cartn_z");
      case gemmi_bridge::CifFile::Found::no:
        break;
    }
    if (cif.value_of("_atom_site_fract_x"))
      throw BadInput(file + " is a CIF file with fractional coordinates; only mmCIF files are read");
    if (const std::optional<std::string> component = cif.value_of("_chem_comp_atom.comp_id"))
      throw BadInput(file + " is the definition of a chemical component (" + shown(*component) +
                     "), which has ideal coordinates at most, not a structure with atoms (_atom_site)");
    return {};
  });
}

AtomRecords read_pqr(std::string_view bytes, const std::string& file, const Progress& progress) {
  progress.update(kStep, 0);
  return guarded(file, [&] {
    AtomRecords all = PqrReader(file, progress).read(bytes);
    identify_atoms(all);
    return all;
  });
}

}  // namespace morsel::core
