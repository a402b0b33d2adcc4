#pragma once
/// A command as a table of its options: what the parser, --help, the man pages and the completions are made
/// from.

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "morsel/tools/commands/console.h"

namespace morsel::tools {

/// What a value is, for completions.
enum class ValueKind : std::uint8_t { text, path, function, method };

/// What stands for standard output in a file's place.
inline constexpr std::string_view kStandardOutput = "-";
/// The option that names its format.
inline constexpr const char* kFormatOption = "--as";

/// The formats of an output, without dots, that standard output can get: the only one, the one that --as
/// names or, if that is not given, `standard`; if this is empty, too, --as is needed.
struct OutputFormats {
  std::vector<std::string> names;
  std::string standard = names.size() == 1 ? names[0] : "";
};

/// A row of the table. The functions that return the row itself refine it.
struct Option {
  std::string names;              ///< "MESH" of an argument, "-o,--output" of an option
  std::string help;               ///< a line: what --help shows
  std::string value_name = {};    ///< what stands for a value in texts; a flag has none
  std::string default_text = {};  ///< empty: none is shown
  std::string implied = {};       ///< the value of the name alone; then one is given as --name=VALUE only
  std::string in_short = {};      ///< what completions show; empty: `help` up to the end of its first clause
  std::string details = {};       ///< what man pages say besides; line breaks are made by whoever shows it
  std::string group = {};         ///< the heading that help shows it under, with its neighbours
  std::string told_by = {};       ///< the command whose help tells it: here help shows the name alone
  std::string negation = {};      ///< the name of the flag that says no
  std::string environment = {};   ///< a variable that gives the value if the option is not given
  std::vector<std::string> choices = {};
  std::vector<std::string> needed = {};    ///< options without which this one is refused
  std::vector<std::string> excluded = {};  ///< options with which it is
  double least = 0;                        ///< of numbers
  double most = std::numeric_limits<double>::infinity();
  bool is_least_excluded = false;
  bool is_required = false;
  bool is_repeated = false;  ///< may be given several times
  ValueKind kind = ValueKind::text;
  std::optional<OutputFormats> output = {};  ///< the value is a file to write
  bool shapes_result = true;                 ///< otherwise the contents of files are the same with any value
  /// Takes the words that were given for it; for a flag "yes" or "no". Throws InvalidArgument.
  std::function<void(const Option& option, const std::vector<std::string>& words)> take = {};

  bool is_flag() const { return value_name.empty(); }
  /// Whether the word after its name is its value.
  bool takes_word() const { return !is_flag() && implied.empty(); }
  bool is_argument() const { return !names.starts_with('-'); }
  /// Each of the names, the short one first, the negation last.
  std::vector<std::string> all_names() const;
  bool is_called(std::string_view any_name) const;

  Option& value(std::string name);
  /// The value is the name of a Morse function, with keys (F), or of a method or chain of methods (M).
  Option& is_function();
  Option& is_method();
  Option& required();
  Option& shows_default(std::string text);
  Option& shortly(std::string text);
  Option& in_detail(std::string text);
  /// Where outputs go, threads, messages: a provenance leaves it out.
  Option& shapes_nothing();
  Option& between(double low, double high);
  Option& above(double low);
  Option& among(std::vector<std::string> words);
  Option& needs(std::string other);
  Option& excludes(std::string other);
};

/// What can be written in a shell, and what it does.
struct Example {
  std::string words;  ///< after "morsel "
  std::string does;
};

/// Targets of options must live as long as the command. What they hold when the option is added is its
/// default.
class Command {
 public:
  using Action = std::function<int(Console&)>;

  Command(std::string called, std::string does) : name(std::move(called)), summary(std::move(does)) {}

  std::string name;
  std::string summary;  ///< a line
  std::vector<Example> examples;
  std::string notes;    ///< what is to be known besides the options: paragraphs, separated by an empty line
  std::string details;  ///< likewise, what man pages say besides
  Action action;        ///< returns the exit code

  /// The heading of the options that are added from here on.
  void begin_group(std::string heading) { group_ = std::move(heading); }

  Option& flag(std::string names, bool& target, std::string help);
  /// With a flag of the opposite meaning: "--points" and "--no-points".
  Option& switches(std::string names, std::string negation, bool& target, std::string help);
  Option& switches(std::string names, std::string negation, std::optional<bool>& target, std::string help);
  Option& text(std::string names, std::string& target, std::string help);
  /// May be given several times; what is given replaces the default.
  Option& texts(std::string names, std::vector<std::string>& target, std::string help);
  /// A file or folder: '' names none and is refused.
  Option& path(std::string names, std::string& target, std::string help);
  Option& path(std::string names, std::filesystem::path& target, std::string help);
  Option& paths(std::string names, std::vector<std::string>& target, std::string help);
  /// A file to write, or - for standard output; adds --as where there is a choice of formats.
  Option& output(std::string names, std::string& target, OutputFormats formats, std::string help);
  /// Numbers separated by commas; may be given several times.
  Option& numbers(std::string names, std::vector<double>& target, std::string help);

  /// One of the names, which stands for a value.
  template <class Target, class Value>
  Option& choice(std::string names, Target& target, std::vector<std::pair<std::string, Value>> choices,
                 std::string help);
  /// The same for values that to_string() names.
  template <class Value, class Values = std::initializer_list<Value>>
  Option& choice(std::string names, Value& target, const Values& values, std::string help) {
    std::vector<std::pair<std::string, Value>> choices;
    for (const Value value : values) choices.emplace_back(to_string(value), value);
    return choice(std::move(names), target, std::move(choices), std::move(help));
  }
  /// Integers of 0 and above, or finite real numbers; between() narrows that.
  template <class Number>
  Option& number(std::string names, Number& target, std::string help);

  /// A row that is none of the above.
  Option& add(Option option);

  const std::deque<Option>& options() const { return options_; }
  /// One that was added, by any of its names.
  Option& option(std::string_view any_name);

 private:
  Option& add_path(std::string names, std::string help, std::function<void(const std::string&)> take);
  void add_formats(const std::string& output_name, const OutputFormats& formats);

  std::deque<Option> options_;  // whose rows stay where they are
  std::string group_;
};

/// The command line as a Provenance has it: `words` follow the command's name; those that shape nothing are
/// left out.
std::string shaping_command(const Command& command, const std::vector<std::string>& words);

/// The number that a word is; throws InvalidArgument, with the range that the option has.
std::uint64_t whole_number(const Option& option, const std::string& word, std::uint64_t most);
double real_number(const Option& option, const std::string& word);
/// As help shows a default.
std::string number_text(double value);

template <class Target, class Value>
Option& Command::choice(std::string names, Target& target, std::vector<std::pair<std::string, Value>> choices,
                        std::string help) {
  Option row{std::move(names), std::move(help), "WHICH"};
  for (const auto& [word, value] : choices) {
    row.choices.push_back(word);
    if constexpr (std::is_same_v<Target, Value>)
      if (value == target) row.default_text = word;
  }
  row.take = [&target, choices](const Option& option, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < choices.size(); ++i)
      if (option.choices[i] == words.back()) target = choices[i].second;
  };
  return add(std::move(row));
}

template <class Number>
Option& Command::number(std::string names, Number& target, std::string help) {
  Option row{std::move(names), std::move(help), "N"};
  using Plain =
      typename std::conditional_t<std::is_arithmetic_v<Number>, std::optional<Number>, Number>::value_type;
  if constexpr (std::is_arithmetic_v<Number>) row.default_text = number_text(static_cast<double>(target));
  row.take = [&target](const Option& option, const std::vector<std::string>& words) {
    if constexpr (std::is_floating_point_v<Plain>)
      target = static_cast<Plain>(real_number(option, words.back()));
    else
      target = static_cast<Plain>(
          whole_number(option, words.back(), static_cast<std::uint64_t>(std::numeric_limits<Plain>::max())));
  };
  return add(std::move(row));
}

}  // namespace morsel::tools
