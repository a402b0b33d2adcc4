#include "morsel/core/text/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "morsel/core/text/listed.h"

namespace morsel::core {
namespace {

std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;              // row i - 2
  std::vector<std::size_t> last(b.size() + 1);  // row i - 1
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(last, std::move(row));
  }
  return last.back();
}

}  // namespace

std::string nearest_name(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t kLongest = 64;  // longer texts are not compared
  if (word.size() > kLongest) return "";
  std::string best;
  std::size_t least = (word.size() + 1) / 3 + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t steps = distance(word, candidate);
    if (steps >= least) continue;
    least = steps;
    best = candidate;
  }
  return best;
}

std::string nearest_hint(std::string_view word, std::span<const std::string> candidates) {
  const std::string name = nearest_name(word, candidates);
  return name.empty() ? "" : "; did you mean " + name + "?";
}

std::string nearest_of(std::string_view word, std::span<const std::string> candidates, std::string lead) {
  std::string hint = nearest_hint(word, candidates);
  if (!hint.empty() && !lead.empty() && lead[0] >= 'a' && lead[0] <= 'z')
    lead[0] = static_cast<char>(lead[0] - 'a' + 'A');
  return hint + (hint.empty() ? "; " : " ") + lead + ": " + listed(candidates);
}

std::string must_be_one_of(std::span<const std::string> choices, std::string_view word) {
  return "must be " + listed(choices, " or ") + ", not \"" + std::string(word) + "\"" +
         nearest_hint(word, choices);
}

}  // namespace morsel::core
