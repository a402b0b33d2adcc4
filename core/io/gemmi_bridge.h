#pragma once
/// The functions of gemmi that this project uses, without gemmi's headers. Internal.
///
/// Implemented in a source in C++17, so with the standard library's types alone: in C++20, clang refuses
/// gemmi's vectors of incomplete types. Functions throw what gemmi throws, std::exception with a message.

#include <array>
#include <cstddef>
#include <memory>
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

struct Residue {
  bool water;
  bool polymer;  ///< amino acid or nucleotide
};
Residue find_residue(const std::string& name);

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
  std::string element, name, chain, sequence_id;
  PdbResidue residue;
  int serial;
  double occupancy;
  char alternate;  ///< 0 if there is only one location
  bool hetero;
};

/// The atom of a line ATOM or HETATM, and the number in a line MODEL.
PdbAtom read_pdb_atom(const PdbLine& line);
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
  /// Whether some block has the tag.
  bool has_tag(const std::string& tag) const;

  std::size_t rows() const;
  /// The value without its quotes; empty if it is ., ? or missing.
  std::string text(std::size_t row, std::size_t column) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace morsel::core::gemmi_bridge
