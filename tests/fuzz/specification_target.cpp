#include "morsel/core/text/specification.h"

#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"
#include "number.h"
#include "target.h"

namespace {

using namespace morsel;
using core::InvalidArgument;

bool same(const core::Specification& a, const core::Specification& b) {
  return a.name == b.name && a.given == b.given;
}

/// A number, an integer and a length of a text are read back from what is written of them.
void check_scalars(std::string_view text) {
  try {
    const double number = core::parse_number(text, "fuzz");
    fuzz::require(fuzz::same_number(core::parse_number(core::shortest(number), "fuzz"), number), "a number");
  } catch (const InvalidArgument&) {
  }
  try {
    const std::int64_t number = core::parse_integer(text, "fuzz");
    fuzz::require(core::parse_integer(std::to_string(number), "fuzz") == number, "an integer");
  } catch (const InvalidArgument&) {
  }
  try {
    const core::Length length = core::parse_length(text, "fuzz");
    const core::Length again = core::parse_length(core::to_string(length), "fuzz");
    fuzz::require(fuzz::same_number(again.value, length.value) && again.unit == length.unit, "a length");
  } catch (const InvalidArgument&) {
  }
}

/// Each key as every kind of value that there is.
void read_keys(const core::Specification& specification) {
  for (int kind = 0; kind < 7; ++kind) {
    try {
      core::ParameterReader reader(specification);
      for (const auto& [key, value] : specification.given) {
        if (kind == 0) reader.number(key, 1, core::kPositive, "");
        if (kind == 1) fuzz::require(reader.count(key, 1, -5, 5, "") <= 5, "a count beyond its range");
        if (kind == 2) reader.length(key, {}, core::kNonNegative, "");
        if (kind == 3) reader.flag(key, false, "");
        if (kind == 4) reader.choice(key, "a", {"a", "b"}, "");
        if (kind == 5) reader.text(key, "", "");
        if (kind == 6) reader.list(key, "", "");
      }
      reader.finish();
      for (const auto& [key, value] : specification.given)  // each once, or finish() had refused it
        fuzz::require(reader.text(key, "", "") == core::unescape(value), "a text");
    } catch (const InvalidArgument&) {
    }
  }
}

}  // namespace

void morsel::fuzz::specification(std::string_view bytes) {
  const std::string literal = core::escape(bytes);
  require(core::unescape(literal) == bytes, "a text that is escaped comes back");
  require(core::split_unescaped(literal, ',').size() == 1, "an escaped comma separates nothing");
  std::string joined;
  for (const std::string_view piece : core::split_unescaped(bytes, '+'))
    joined.append(joined.empty() && piece.data() == bytes.data() ? "" : "+").append(piece);
  require(joined == bytes, "what was split comes together");
  check_scalars(bytes);
  if (!bytes.empty()) {
    const core::Specification one = core::parse_specification("name:key=" + literal, "fuzz");
    require(one.given.size() == 1 && core::unescape(one.given[0].second) == bytes, "an escaped value");
  }
  try {
    const std::vector<core::Specification> chain = core::parse_chain(bytes, "fuzz");
    require(!chain.empty(), "a chain without a link");
    const std::vector<core::Specification> again = core::parse_chain(core::to_string(chain), "fuzz");
    require(std::equal(chain.begin(), chain.end(), again.begin(), again.end(), same),
            "a chain that is written comes back");
    for (const core::Specification& link : chain) {
      require(!link.name.empty(), "a link without a name");
      read_keys(link);
    }
  } catch (const InvalidArgument&) {
  }
}
