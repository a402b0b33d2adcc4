#include <optional>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/atom_selection.h"
#include "target.h"

namespace {

std::optional<morsel::core::AtomSelection> selection(const std::string& text) {
  try {
    return morsel::core::AtomSelection(text);
  } catch (const morsel::core::InvalidArgument& error) {
    morsel::fuzz::require(std::string(error.what()).find("at character ") != std::string::npos,
                          "an error without its place");
    return std::nullopt;
  }
}

}  // namespace

void morsel::fuzz::selection(std::string_view bytes) {
  const std::string text(bytes);
  const auto plain = ::selection(text);
  if (!plain) return;
  const auto negated = ::selection("not (" + text + ")");  // which may be too deep
  const auto both = ::selection("(" + text + ") and " + text + " or " + text);
  core::Atom atom;
  for (const char* residue : {"GLY", "HOH", "A"})
    for (const char* place : {"1", "52", "52A", "-3", ""}) {
      atom.residue = residue;
      atom.name = "CA";
      atom.element = "C";
      atom.chain = "A";
      atom.sequence_id = place;
      atom.water = atom.residue == "HOH";
      atom.polymer = !atom.water;
      const bool taken = plain->takes(atom);
      require(!negated || negated->takes(atom) != taken, "a negation");
      require(!both || both->takes(atom) == taken, "a conjunction with itself");
    }
}
