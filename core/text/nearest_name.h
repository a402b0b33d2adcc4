#pragma once
/// The name nearest to a mistyped one.

#include <span>
#include <string>
#include <string_view>

namespace morsel::core {

/// The candidate with the fewest letters added, left out, replaced or swapped with their neighbour (optimal
/// string alignment distance), the first of several; "" if that is more than a third of them.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean NAME?", or "" if there is none.
std::string nearest_hint(std::string_view word, std::span<const std::string> candidates);

/// The same with all candidates: "; did you mean NAME? There are: A, B", or "; there are: A, B", where
/// `listed` is "there are".
std::string nearest_of(std::string_view word, std::span<const std::string> candidates, std::string lead);

/// What is wrong with a word that is none of `choices`: "must be a, b or c, not "WORD"", with nearest_hint().
std::string must_be_one_of(std::span<const std::string> choices, std::string_view word);

}  // namespace morsel::core
