#pragma once
/// Parameters by name: how methods and functions are made from text such as "iterations=10,sigma=8eps", how
/// their keys are listed for help, and how resolved values reach a report.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "morsel/core/mesh/length.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/specification.h"

namespace morsel::core {

/// A resolved value as a report holds it.
using ParameterValue = std::variant<bool, std::int64_t, double, std::string>;

/// Resolved parameters, in the order in which they are shown.
using Parameters = std::vector<std::pair<std::string, ParameterValue>>;

/// What a key's value is, by the call that declared it.
enum class ParameterKind : std::uint8_t { number, count, length, flag, choice, text, list };

/// A key as help shows it.
struct ParameterInfo {
  std::string key;
  std::string default_value;  ///< as text; empty if the key must be given
  std::string description;
  ParameterKind kind = ParameterKind::text;
  std::vector<std::string> choices = {};  ///< of a choice
};

/// A file that a key names, to be read besides the mesh's.
struct FileParameter {
  std::string key;
  std::string path;
};

/// Inclusive or exclusive lower bound and inclusive upper bound of a number.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  bool min_exclusive = false;
  double max = std::numeric_limits<double>::infinity();
};
inline constexpr Range kPositive{0, true};
inline constexpr Range kNonNegative{0, false};

/// Reads a specification key by key. Each call declares one key, with its default and a description, and
/// returns its value; finish() then throws if a key was given that was not declared. So a method declares
/// each of its keys once, and help, checking and reading follow from it. All calls throw InvalidArgument,
/// naming the owner, the key, the value and what is allowed.
class ParameterReader {
 public:
  explicit ParameterReader(Specification specification);

  double number(std::string_view key, double default_value, Range range, std::string_view description);
  std::int64_t count(std::string_view key, std::int64_t default_value, std::int64_t min, std::int64_t max,
                     std::string_view description);
  Length length(std::string_view key, Length default_value, Range range, std::string_view description);
  bool flag(std::string_view key, bool default_value, std::string_view description);
  /// One of `choices`, which help lists after the description.
  std::string choice(std::string_view key, std::string_view default_value,
                     const std::vector<std::string_view>& choices, std::string_view description);
  /// Free text; a null default makes the key mandatory.
  std::string text(std::string_view key, const char* default_value, std::string_view description);
  /// The path of a file that is going to be read, as text(); files() then lists it, so that reports hash it
  /// and no output may overwrite it.
  std::string file(std::string_view key, const char* default_value, std::string_view description);
  /// One of `words`, or else the path of a file, as file().
  std::string word_or_file(std::string_view key, const char* default_value,
                           const std::vector<std::string_view>& words, std::string_view description);
  /// Texts separated by "/"; the default is given in the same form, null makes the key mandatory.
  std::vector<std::string> list(std::string_view key, const char* default_value,
                                std::string_view description);
  /// Whether the key was given; declares nothing.
  bool given(std::string_view key) const;

  /// Throws InvalidArgument, listing the valid keys, if a key was given that nothing declared, or one twice.
  void finish() const;

  const std::string& owner() const { return specification_.name; }
  const std::vector<ParameterInfo>& declared() const { return declared_; }
  /// The files that file() has returned, but for empty paths.
  const std::vector<FileParameter>& files() const { return files_; }

  /// A reader that returns defaults (and empty text for mandatory keys), to list the declared keys.
  static ParameterReader for_help(std::string name);
  /// A reader of keys that are options of a command: errors name them as such, "--model" for
  /// "molecule:model".
  static ParameterReader of_options(Specification specification);

 private:
  const std::string* declare(ParameterInfo info, bool required = false);
  std::string choose(ParameterInfo info);

  /// A key as errors name it.
  std::string shown(std::string_view key) const;

  Specification specification_;
  std::vector<ParameterInfo> declared_;
  std::vector<FileParameter> files_;
  bool for_help_ = false;
  bool are_options_ = false;
};

/// The whole text as a finite number ("1e-3", "-2"); throws InvalidArgument naming `what` otherwise.
double parse_number(std::string_view text, std::string_view what);

/// The whole text as an integer; throws InvalidArgument naming `what` otherwise.
std::int64_t parse_integer(std::string_view text, std::string_view what);

/// "0.25" (unit of the mesh), "8eps", "3edges" (or "3edge"), "5%" (of the bounding box's diagonal) or
/// "0.02rootarea".
Length parse_length(std::string_view text, std::string_view what);

}  // namespace morsel::core
