#include "morsel/tools/commands/parser.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/nearest_name.h"

namespace morsel::tools {
namespace {

/// An option and what the parser has of it.
struct Parsed {
  const Option* option = nullptr;
  CLI::Option* given = nullptr;
  CLI::Option* denied = nullptr;  // by the negation of a flag

  std::size_t count() const { return given->count() + (denied != nullptr ? denied->count() : 0); }
};

[[noreturn]] void refuse(const Command& command, const std::string& sentence) {
  throw core::InvalidArgument(sentence + " (morsel " + command.name + " --help lists the options)");
}

std::vector<Parsed> declare(const Command& command, CLI::App& app) {
  std::vector<Parsed> rows;
  for (const Option& option : command.options()) {
    Parsed row{&option};
    if (!option.implied.empty()) {
      row.given = app.add_flag(option.names + "{" + option.implied + "}")->take_all();
    } else if (option.is_flag()) {
      row.given = app.add_flag(option.names)->disable_flag_override();
      if (!option.negation.empty()) row.denied = app.add_flag(option.negation)->disable_flag_override();
    } else {
      row.given = app.add_option(option.names)->take_all();
      if (option.is_repeated)
        row.given->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args(option.is_argument());
      if (!option.environment.empty()) row.given->envname(option.environment);
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<std::string> option_names(const Command& command) {
  std::vector<std::string> names = {"--help"};
  for (const Option& option : command.options()) {
    if (option.is_argument()) continue;
    for (std::string& name : option.all_names()) names.push_back(std::move(name));
  }
  return names;
}

/// Whether the option takes the word; sets its target, if so.
bool takes(const Option& option, const std::string& word) {
  try {
    option.take(option, {word});
    return true;
  } catch (const core::InvalidArgument&) {
    return false;
  }
}

/// "; a value of --weld is written with =: --weld=0.01" where the name of an option with an optional value is
/// followed by what would be one.
std::string hint_at_value(const Command& command, const std::vector<std::string>& words) {
  for (std::size_t i = 0; i + 1 < words.size() && words[i] != "--"; ++i)
    for (const Option& option : command.options())
      if (!option.implied.empty() && option.is_called(words[i]) && takes(option, words[i + 1]))
        return "; a value of " + words[i] + " is written with =: " + words[i] + "=" + words[i + 1];
  return "";
}

/// `words` are those that were given.
[[noreturn]] void refuse_unexpected(const Command& command, const std::string& word,
                                    const std::vector<std::string>& words) {
  if (!word.starts_with('-') || word.size() == 1)
    refuse(command, "\"" + word + "\" is one argument too many" + hint_at_value(command, words));
  const std::string name = word.substr(0, word.find('='));
  const bool is_letter = name.size() == 2;  // which is near to every other
  refuse(command,
         "there is no option " + name + (is_letter ? "" : core::nearest_hint(name, option_names(command))));
}

/// What CLI11 has against the option that its message begins with.
[[noreturn]] void refuse_mismatch(const Command& command, const std::string& message) {
  const std::string begin = message.substr(0, message.find_first_of(": "));
  for (const Option& option : command.options()) {
    const std::vector<std::string> names = option.all_names();
    for (const std::string& name : names)  // CLI11 leaves out the dashes of a flag
      if (name == begin || name == "--" + begin || name == "-" + begin)
        refuse(command, option.is_flag() ? name + " takes no value"
                                         : names.front() + " needs a value: " + option.value_name);
  }
  refuse(command, message);
}

void check(const Command& command, const std::vector<Parsed>& rows) {
  const auto is_given = [&](const std::string& name) {
    return std::ranges::any_of(
        rows, [&](const Parsed& row) { return row.count() > 0 && row.option->is_called(name); });
  };
  for (const Parsed& row : rows) {
    const Option& option = *row.option;
    const std::string name = option.all_names().front();
    if (row.count() == 0) continue;
    if (!option.is_flag() && !option.is_repeated && row.count() > 1)
      refuse(command, name + " was given " + std::to_string(row.count()) + " times");
    if (const auto other = std::ranges::find_if_not(option.needed, is_given); other != option.needed.end())
      refuse(command, name + " needs " + *other);
    if (const auto other = std::ranges::find_if(option.excluded, is_given); other != option.excluded.end())
      refuse(command, name + " and " + *other + " exclude one another");
    if (option.choices.empty()) continue;
    const std::vector<std::string>& words = row.given->results();
    const auto word = std::ranges::find_if(words, [&](const std::string& given) {
      return std::ranges::find(option.choices, given) == option.choices.end();
    });
    if (word != words.end()) refuse(command, name + " " + core::must_be_one_of(option.choices, *word));
  }
}

void check_required(const Command& command, const std::vector<Parsed>& rows) {
  for (const Parsed& row : rows) {
    const Option& option = *row.option;
    if (option.is_required && row.count() == 0)
      refuse(command, command.name + " needs " + option.all_names().front() +
                          (option.is_argument() ? "" : " " + option.value_name));
  }
}

/// The format of the one output that is standard output; "" if none is.
std::string standard_output_format(const Command& command, const std::vector<Parsed>& rows) {
  const Option* output = nullptr;
  std::string format;
  for (const Parsed& row : rows) {
    if (row.count() == 0) continue;
    const std::string& word = row.given->results().back();
    if (row.option->is_called(kFormatOption)) format = word;
    if (!row.option->output || word != kStandardOutput) continue;
    if (output != nullptr)
      refuse(command, output->all_names().front() + " and " + row.option->all_names().front() +
                          " are both standard output (-), which takes one of them");
    output = row.option;
  }
  if (output == nullptr) {
    if (!format.empty())
      refuse(command,
             std::string(kFormatOption) + " " + format +
                 " is the format of standard output, and no output is -; a file's name says its own");
    return "";
  }
  const OutputFormats& formats = *output->output;
  const std::string names = core::listed(formats.names, " or ");
  if (format.empty() && formats.standard.empty())
    refuse(command,
           "of standard output (-) the format must be given: " + std::string(kFormatOption) + " " + names);
  if (!format.empty() && std::ranges::find(formats.names, format) == formats.names.end())
    refuse(command, output->all_names().front() + " - is written as " + names + ", not as " + format);
  return format.empty() ? formats.standard : format;
}

}  // namespace

std::string parse(Command& command, const std::vector<std::string>& words) {
  CLI::App app;
  app.set_help_flag();
  const std::vector<Parsed> rows = declare(command, app);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ExtrasError&) {
    const std::vector<std::string> unexpected = app.remaining();
    const auto option =
        std::ranges::find_if(unexpected, [](const std::string& word) { return word.starts_with('-'); });
    refuse_unexpected(command, option != unexpected.end() ? *option : unexpected.at(0), words);
  } catch (const CLI::ArgumentMismatch& error) {
    refuse_mismatch(command, error.what());
  } catch (const CLI::ParseError& error) {
    refuse(command, error.what());
  }
  check(command, rows);
  std::string format = standard_output_format(command, rows);
  for (const Parsed& row : rows) {
    if (row.count() == 0) continue;
    const std::vector<std::string> flags = {row.denied != nullptr && row.denied->count() > 0 ? "no" : "yes"};
    row.option->take(*row.option, row.option->is_flag() ? flags : row.given->results());
  }
  check_required(command, rows);
  return format;
}

}  // namespace morsel::tools
