#include "morsel/tools/commands/command.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/command_line.h"

namespace morsel::tools {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

[[noreturn]] void refuse(const Option& option, const std::string& wanted, const std::string& word) {
  throw core::InvalidArgument(option.all_names().front() + " must be " + wanted + ", not \"" + word + "\"");
}

bool is_in_range(const Option& option, double value) {
  return (option.is_least_excluded ? value > option.least : value >= option.least) && value <= option.most;
}

std::string range_text(const Option& option) {
  const std::string low = number_text(option.least);
  if (option.is_least_excluded) return " above " + low;
  if (std::isfinite(option.most)) return " from " + low + " to " + number_text(option.most);
  return option.least == 0 || !std::isfinite(option.least) ? "" : " of at least " + low;
}

}  // namespace

std::vector<std::string> Option::all_names() const {
  std::vector<std::string> all = split(names, ',');
  if (!negation.empty()) all.push_back(negation);
  return all;
}

bool Option::is_called(std::string_view any_name) const {
  const std::vector<std::string> all = all_names();
  return std::ranges::find(all, any_name) != all.end();
}

Option& Option::value(std::string name) {
  value_name = std::move(name);
  return *this;
}

Option& Option::is_function() {
  kind = ValueKind::function;
  return value("F");
}

Option& Option::is_method() {
  kind = ValueKind::method;
  return value("M");
}

Option& Option::required() {
  is_required = true;
  return *this;
}

Option& Option::shows_default(std::string text) {
  default_text = std::move(text);
  return *this;
}

Option& Option::shortly(std::string text) {
  in_short = std::move(text);
  return *this;
}

Option& Option::in_detail(std::string text) {
  details = std::move(text);
  return *this;
}

Option& Option::shapes_nothing() {
  shapes_result = false;
  return *this;
}

Option& Option::between(double low, double high) {
  least = low;
  most = high;
  return *this;
}

Option& Option::above(double low) {
  least = low;
  is_least_excluded = true;
  return *this;
}

Option& Option::among(std::vector<std::string> words) {
  choices = std::move(words);
  return *this;
}

Option& Option::needs(std::string other) {
  needed.push_back(std::move(other));
  return *this;
}

Option& Option::excludes(std::string other) {
  excluded.push_back(std::move(other));
  return *this;
}

Option& Command::add(Option option) {
  option.group = group_;
  return options_.emplace_back(std::move(option));
}

Option& Command::option(std::string_view any_name) {
  for (Option& row : options_)
    if (row.is_called(any_name)) return row;
  throw core::InvalidArgument(name + " has no option " + std::string(any_name));
}

Option& Command::flag(std::string names, bool& target, std::string help) {
  return switches(std::move(names), "", target, std::move(help));
}

Option& Command::switches(std::string names, std::string negation, bool& target, std::string help) {
  Option row{std::move(names), std::move(help)};
  row.negation = std::move(negation);
  row.take = [&target](const Option&, const std::vector<std::string>& words) {
    target = words.back() == "yes";
  };
  return add(std::move(row));
}

Option& Command::switches(std::string names, std::string negation, std::optional<bool>& target,
                          std::string help) {
  Option row{std::move(names), std::move(help)};
  row.negation = std::move(negation);
  row.take = [&target](const Option&, const std::vector<std::string>& words) {
    target = words.back() == "yes";
  };
  return add(std::move(row));
}

Option& Command::text(std::string names, std::string& target, std::string help) {
  Option row{std::move(names), std::move(help), "TEXT", target};
  row.take = [&target](const Option&, const std::vector<std::string>& words) { target = words.back(); };
  return add(std::move(row));
}

Option& Command::texts(std::string names, std::vector<std::string>& target, std::string help) {
  Option row{std::move(names), std::move(help), "TEXT"};
  row.is_repeated = true;
  for (const std::string& word : target) row.default_text += (row.default_text.empty() ? "" : ", ") + word;
  row.take = [&target](const Option&, const std::vector<std::string>& words) { target = words; };
  return add(std::move(row));
}

Option& Command::add_path(std::string names, std::string help, std::function<void(const std::string&)> take) {
  Option row{std::move(names), std::move(help), "FILE"};
  row.kind = ValueKind::path;
  row.take = [take = std::move(take)](const Option& option, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      if (word.empty()) throw core::InvalidArgument(option.all_names().front() + ": '' names no file");
      take(word);
    }
  };
  return add(std::move(row));
}

Option& Command::path(std::string names, std::string& target, std::string help) {
  return add_path(std::move(names), std::move(help), [&target](const std::string& word) { target = word; });
}

Option& Command::path(std::string names, std::filesystem::path& target, std::string help) {
  return add_path(std::move(names), std::move(help), [&target](const std::string& word) { target = word; })
      .shows_default(target.string());
}

Option& Command::paths(std::string names, std::vector<std::string>& target, std::string help) {
  Option& row = add_path(std::move(names), std::move(help),
                         [&target](const std::string& word) { target.push_back(word); });
  row.is_repeated = true;
  return row;
}

Option& Command::output(std::string names, std::string& target, OutputFormats formats, std::string help) {
  Option& row = path(std::move(names), target, std::move(help)).shapes_nothing();
  row.output = std::move(formats);
  if (row.output->names.size() > 1) add_formats(row.all_names().front(), *row.output);
  return row;
}

void Command::add_formats(const std::string& output_name, const OutputFormats& formats) {
  if (std::ranges::none_of(options_, [](const Option& row) { return row.is_called(kFormatOption); })) {
    Option row{kFormatOption, "Format of the output that is - (standard output)", "FORMAT"};
    row.take = [](const Option&, const std::vector<std::string>&) {
    };  // the parser's, as it depends on others
    add(std::move(row)).shapes_nothing();
  }
  Option& row = option(kFormatOption);
  row.choices.insert(row.choices.end(), formats.names.begin(), formats.names.end());
  row.details +=
      (row.details.empty() ? "Of " : "; of ") + output_name + ": " + core::listed(formats.names, " or ");
  if (!formats.standard.empty()) row.details += " (" + formats.standard + " if it is not given)";
}

Option& Command::numbers(std::string names, std::vector<double>& target, std::string help) {
  Option row{std::move(names), std::move(help), "N,N,..."};
  row.is_repeated = true;
  row.least = -std::numeric_limits<double>::infinity();  // whoever takes them has ranges of their own
  row.take = [&target](const Option& option, const std::vector<std::string>& words) {
    target.clear();
    for (const std::string& word : words)
      for (const std::string& part : split(word, ',')) target.push_back(real_number(option, part));
  };
  return add(std::move(row));
}

std::string shaping_command(const Command& command, const std::vector<std::string>& words) {
  std::vector<std::string> kept = {"morsel", command.name};
  for (auto word = words.begin(); word != words.end(); ++word) {
    if (*word == "--") {
      kept.insert(kept.end(), word, words.end());
      break;
    }
    // "--name", "--name=VALUE", "-n" or "-nVALUE"
    const std::string name = word->starts_with("--") ? word->substr(0, word->find('=')) : word->substr(0, 2);
    const auto option = std::ranges::find_if(
        command.options(), [&](const Option& row) { return !row.is_argument() && row.is_called(name); });
    if (option == command.options().end() || option->shapes_result)
      kept.push_back(*word);
    else if (option->takes_word() && *word == name && word + 1 != words.end())
      ++word;
  }
  return command_line(kept);
}

std::uint64_t whole_number(const Option& option, const std::string& word, std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value > most ||
      !is_in_range(option, static_cast<double>(value)))
    refuse(option, "a whole number" + range_text(option), word);
  return value;
}

double real_number(const Option& option, const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) ||
      !is_in_range(option, value))
    refuse(option, "a finite number" + range_text(option), word);
  return value;
}

std::string number_text(double value) {
  constexpr double kExact = 1e15;  // up to which a double is printed as the whole number that it is
  return std::abs(value) < kExact && value == std::floor(value)
             ? std::to_string(static_cast<std::int64_t>(value))
             : core::shortest(value);
}

}  // namespace morsel::tools
