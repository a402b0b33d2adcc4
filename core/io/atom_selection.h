#pragma once
/// Which atoms of a molecule to take, as an expression. Internal.
///
///   expression  term { "or" term }
///   term        factor { "and" factor }
///   factor      "not" factor | "(" expression ")" | group | property value { value }
///   group       all | polymer | ligand | ion | water | hydrogen | hetero
///   property    chain | resname | residue | name | element
///
/// Values are separated by blanks or commas and end before and, or, ")" and the end; one that is such a word,
/// or has blanks, commas or parentheses, is put in double quotes. `residue` takes numbers with insertion
/// codes and ranges: 52 52A 10-20 -5--2 52-52B. A range has what lies between its ends in the order of the
/// chain, 52 before 52A. Names of chains are as in the file, capitals or not; elsewhere, and in keywords,
/// case does not matter. Groups: an ion is a single atom; a ligand is what is no polymer, ion or water;
/// hetero is what HETATM records hold.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/molecule.h"

namespace morsel::core {

class AtomSelection {
 public:
  /// Throws InvalidArgument, with the position in the text (characters from 1), if it is not an expression,
  /// or has more than 100 parentheses and negations in one another. Linear in the text.
  explicit AtomSelection(std::string_view text);

  /// O(length of the text).
  bool takes(const Atom& atom) const;

 private:
  enum class Operation : std::uint8_t {
    all,
    polymer,
    ligand,
    ion,
    water,
    hydrogen,
    hetero,
    chain,
    residue_name,
    residue,
    name,
    element,
    negation,
    conjunction,
    disjunction
  };
  /// The number of a residue and its insertion code.
  struct Place {
    std::int64_t number = 0;
    std::string code;
    auto operator<=>(const Place&) const = default;
  };
  struct Stretch {
    Place first, last;
  };
  /// A step of the expression, operands first.
  struct Step {
    Operation operation = Operation::all;
    std::vector<std::string> names = {};
    std::vector<Stretch> stretches = {};
  };
  class Parser;

  static bool parse_place(std::string_view& text, Place& place);
  bool holds(const Step& step, const Atom& atom) const;

  std::vector<Step> steps_;
};

}  // namespace morsel::core
