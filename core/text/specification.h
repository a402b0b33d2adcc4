#pragma once
/// The text form in which functions and methods are chosen: "name", "name:key=value,key=value", chains
/// "a:…+b:…".

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace morsel::core {

/// A name and its keys as the user gave them: "salient" and {iterations: "10", …}. Values are raw: a
/// backslash still stands before each character that is to be taken literally.
struct Specification {
  std::string name;
  std::vector<std::pair<std::string, std::string>> given;
};

/// Reads "name:key=value,key=value+name…" into one specification per link of the chain. A backslash keeps the
/// next character ( , : + = / \ ) from separating. Throws InvalidArgument, quoting the text, on an empty name
/// or key or a key without "=". `what` names the text in errors ("--method").
std::vector<Specification> parse_chain(std::string_view text, std::string_view what);

/// parse_chain() for a single specification; throws InvalidArgument if the text is a chain.
Specification parse_specification(std::string_view text, std::string_view what);

/// The text that parse_chain() reads it from.
std::string to_string(const Specification& specification);
std::string to_string(const std::vector<Specification>& chain);

/// Removes the backslashes.
std::string unescape(std::string_view raw);

/// Puts a backslash before every separator, so that parse_chain() reads the text back literally.
std::string escape(std::string_view text);

/// Splits at each `separator` that no backslash precedes; keeps the backslashes.
std::vector<std::string_view> split_unescaped(std::string_view raw, char separator);

}  // namespace morsel::core
