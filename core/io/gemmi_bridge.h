#pragma once
/// The functions of gemmi that this project uses, without gemmi's headers. Internal.
///
/// Implemented in a source in C++17, so with the standard library's types alone: in C++20, clang refuses
/// gemmi's vectors of incomplete types. Functions throw what gemmi throws, std::exception with a message.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace morsel::core::gemmi_bridge {

struct Element {
  std::string symbol;  ///< "Ca"; "X" if there is no such element
  double radius;       ///< van der Waals, in Å; 0 if there is no such element
  bool hydrogen;       ///< or deuterium
};
Element find_element(const std::string& symbol);

/// What gemmi's table says of a residue's name, in capital letters.
struct Residue {
  bool known = false;
  bool water = false;
  bool amino_acid = false;
  bool nucleotide = false;
  bool standard = false;  ///< one of the amino acids and nucleotides that are not modified
  std::string ion;        ///< the element of a single atom ("CL", "ZN2", "BRO"); empty if it is none
};
Residue find_residue(const std::string& name);

/// The element of an atom by its name as columns 13 to 16 of a PDB file have it, where the element's symbol
/// ends in column 14; "X" if there is none.
std::string element_by_columns(const std::array<char, 4>& name);

/// A line of a PDB file: 78 columns and a 0.
using PdbLine = std::array<char, 79>;

/// Identifies a residue in its chain.
struct PdbResidue {
  int number = 0;
  char insertion = ' ';  ///< as a small letter
  std::string segment, name;
  bool operator==(const PdbResidue& o) const {
    return number == o.number && insertion == o.insertion && segment == o.segment && name == o.name;
  }
  bool operator<(const PdbResidue& o) const {
    return std::tie(number, insertion, segment, name) < std::tie(o.number, o.insertion, o.segment, o.name);
  }
};

struct PdbAtom {
  double x, y, z;
  std::array<char, 4> columns;  ///< of the name
  std::string symbol;           ///< of the element, as it is there: may be empty or none
  std::string name, chain, sequence_id;
  PdbResidue residue;
  int serial;
  double occupancy;
  char alternate;  ///< 0 if there is only one location
  bool hetero;
};

/// The atom of a line ATOM or HETATM, and the number in a line MODEL. The name of a residue is in columns 18
/// to 20 and that of its chain in 21 and 22; of a long name it is 18 to 21 and 22.
PdbAtom read_pdb_atom(const PdbLine& line, bool long_residue_name);
int pdb_model_number(const PdbLine& line);

/// A CIF file, and the rows of one of its tables.
class CifFile {
 public:
  CifFile(std::string_view text, const std::string& file);
  ~CifFile();
  CifFile(const CifFile&) = delete;
  CifFile& operator=(const CifFile&) = delete;

  enum class Found { no, without_columns, yes };
  /// Selects the first block whose table `category` has rows, to which rows() and text() then refer. Columns
  /// whose names begin with a ? may be missing.
  Found find(const std::string& category, const std::vector<std::string>& columns);
  /// The value of the tag in the first block that has it, of a pair or a loop's first row; null if none has.
  std::optional<std::string> value_of(const std::string& tag) const;
  /// The rows of another table of the block that find() selected: the columns, of which those that begin with
  /// a ? may be missing, with values as text() gives them. None if it lacks the table or a column.
  std::vector<std::vector<std::string>> rows_of(const std::string& category,
                                                const std::vector<std::string>& columns);

  std::size_t rows() const;
  /// The value without its quotes; empty if it is ., ? or missing.
  std::string text(std::size_t row, std::size_t column) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace morsel::core::gemmi_bridge
