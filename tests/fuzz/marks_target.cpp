#include "morsel/tools/study/marks.h"

#include <algorithm>
#include <string>

#include "morsel/core/error.h"
#include "target.h"

namespace {

using namespace morsel;

std::string quoted(const std::string& path) {
  std::string text = "\"";
  for (const char c : path) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

void check_pairs(std::string_view bytes) {
  const std::vector<tools::MarkedPair> pairs = tools::parse_marked_pairs(bytes, "fuzz");
  fuzz::require(!pairs.empty(), "a list without pairs");
  std::string text = "mesh,vertices\n";
  for (const tools::MarkedPair& pair : pairs) {
    fuzz::require(!pair.mesh.empty() && !pair.marks.empty(), "an empty path");
    text += quoted(pair.mesh) + "," + quoted(pair.marks) + "\n";
  }
  const std::vector<tools::MarkedPair> again = tools::parse_marked_pairs(text, "written");
  fuzz::require(std::ranges::equal(pairs, again,
                                   [](const tools::MarkedPair& a, const tools::MarkedPair& b) {
                                     return a.mesh == b.mesh && a.marks == b.marks;
                                   }),
                "a list written and read again");
}

void check_marks(std::string_view bytes) {
  const std::vector<tools::Mark> marks = tools::parse_marks(bytes, "fuzz");
  fuzz::require(!marks.empty(), "a file without marks");
  const auto lines =
      static_cast<std::size_t>(std::ranges::count(bytes, '\n') + std::ranges::count(bytes, '\r'));
  std::string text;
  for (const tools::Mark& mark : marks) {
    fuzz::require(mark.line >= 1 && mark.line <= lines + 1, "the line of a mark");
    text += std::to_string(mark.number) + "\n";
  }
  const std::vector<tools::Mark> again = tools::parse_marks(text, "written");
  fuzz::require(std::ranges::equal(marks, again, {}, &tools::Mark::number, &tools::Mark::number),
                "marks written and read again");
}

}  // namespace

void morsel::fuzz::marks(std::string_view bytes) {
  for (const auto check : {check_pairs, check_marks}) {
    try {
      check(bytes);
    } catch (const core::BadInput&) {
    }
  }
}
