#include "morsel/core/text/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/nearest_name.h"

namespace morsel::core {
namespace {

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

void check_range(double value, const Range& range, const std::string& what) {
  const bool low = range.min_exclusive ? value <= range.min : value < range.min;
  if (!low && value <= range.max) return;
  std::string allowed;
  if (std::isfinite(range.min))
    allowed = (range.min_exclusive ? "above " : "at least ") + shortest(range.min);
  if (std::isfinite(range.max))
    allowed += (allowed.empty() ? "" : " and ") + ("at most " + shortest(range.max));
  throw InvalidArgument(what + " must be " + allowed + ", not " + shortest(value));
}

ParameterInfo described(std::string_view key, std::string_view default_text, std::string_view description,
                        ParameterKind kind) {
  return {std::string(key), std::string(default_text), std::string(description), kind};
}

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && !text.empty();
}

}  // namespace

std::string to_string(const Length& length) {
  const char* unit = length.unit == LengthUnit::epsilon     ? "eps"
                     : length.unit == LengthUnit::edge      ? "edges"
                     : length.unit == LengthUnit::percent   ? "%"
                     : length.unit == LengthUnit::root_area ? "rootarea"
                                                            : "";
  return shortest(length.value) + unit;
}

double parse_number(std::string_view text, std::string_view what) {
  double value = 0;
  if (!parse_whole(text, value) || !std::isfinite(value))
    throw InvalidArgument(std::string(what) + " must be a finite number, not " + in_quotes(text));
  return value;
}

std::int64_t parse_integer(std::string_view text, std::string_view what) {
  std::int64_t value = 0;
  if (!parse_whole(text, value))
    throw InvalidArgument(std::string(what) + " must be a whole number, not " + in_quotes(text));
  return value;
}

Length parse_length(std::string_view text, std::string_view what) {
  const std::string_view given = text;
  LengthUnit unit = LengthUnit::mesh;
  for (const auto& [name, named] : {std::pair<std::string_view, LengthUnit>("eps", LengthUnit::epsilon),
                                    {"edges", LengthUnit::edge},
                                    {"edge", LengthUnit::edge},
                                    {"%", LengthUnit::percent},
                                    {"rootarea", LengthUnit::root_area}})
    if (unit == LengthUnit::mesh && text.ends_with(name)) {
      text.remove_suffix(name.size());
      unit = named;
    }
  double value = 0;
  if (!parse_whole(text, value) || !std::isfinite(value))
    throw InvalidArgument(
        std::string(what) +
        " must be a length such as 0.25 (in the mesh's unit), 8eps, 3edges, 5% or 0.02rootarea, not " +
        in_quotes(given));
  return {value, unit};
}

ParameterReader::ParameterReader(Specification specification) : specification_(std::move(specification)) {}

ParameterReader ParameterReader::of_options(Specification specification) {
  ParameterReader reader(std::move(specification));
  reader.are_options_ = true;
  return reader;
}

ParameterReader ParameterReader::for_help(std::string name) {
  ParameterReader reader(Specification{std::move(name), {}});
  reader.for_help_ = true;
  return reader;
}

std::string ParameterReader::shown(std::string_view key) const {
  return (are_options_ ? "--" : owner() + ":") + std::string(key);
}

const std::string* ParameterReader::declare(ParameterInfo declared, bool required) {
  const ParameterInfo& info = declared_.emplace_back(std::move(declared));
  for (const auto& [name, value] : specification_.given)
    if (name == info.key) return &value;
  if (required && !for_help_)
    throw InvalidArgument(owner() + " needs " + info.key + "=… (" + info.description + ")");
  return nullptr;
}

bool ParameterReader::given(std::string_view key) const {
  return std::any_of(specification_.given.begin(), specification_.given.end(),
                     [&](const auto& entry) { return entry.first == key; });
}

double ParameterReader::number(std::string_view key, double default_value, Range range,
                               std::string_view description) {
  const std::string* text =
      declare(described(key, shortest(default_value), description, ParameterKind::number));
  if (text == nullptr) return default_value;
  const std::string what = shown(key);
  const double value = parse_number(*text, what);
  check_range(value, range, what);
  return value;
}

std::int64_t ParameterReader::count(std::string_view key, std::int64_t default_value, std::int64_t min,
                                    std::int64_t max, std::string_view description) {
  const std::string* text =
      declare(described(key, std::to_string(default_value), description, ParameterKind::count));
  if (text == nullptr) return default_value;
  const std::string what = shown(key);
  const std::int64_t value = parse_integer(*text, what);
  if (value < min || value > max)
    throw InvalidArgument(what + " must be between " + std::to_string(min) + " and " + std::to_string(max) +
                          ", not " + *text);
  return value;
}

Length ParameterReader::length(std::string_view key, Length default_value, Range range,
                               std::string_view description) {
  const std::string* text =
      declare(described(key, to_string(default_value), description, ParameterKind::length));
  if (text == nullptr) return default_value;
  const std::string what = shown(key);
  const Length value = parse_length(*text, what);
  check_range(value.value, range, what);
  return value;
}

bool ParameterReader::flag(std::string_view key, bool default_value, std::string_view description) {
  ParameterInfo info = described(key, default_value ? "yes" : "no", description, ParameterKind::flag);
  info.choices = {"yes", "no"};
  return choose(std::move(info)) == "yes";
}

std::string ParameterReader::choice(std::string_view key, std::string_view default_value,
                                    const std::vector<std::string_view>& choices,
                                    std::string_view description) {
  ParameterInfo info = described(key, default_value, description, ParameterKind::choice);
  info.choices.assign(choices.begin(), choices.end());
  return choose(std::move(info));
}

std::string ParameterReader::choose(ParameterInfo info) {
  const std::vector<std::string> allowed = info.choices;
  const std::string what = shown(info.key);
  const std::string default_value = info.default_value;
  info.description += " [" + listed(allowed) + "]";
  const std::string* text = declare(std::move(info));
  if (text == nullptr) return default_value;
  if (std::find(allowed.begin(), allowed.end(), *text) != allowed.end()) return *text;
  throw InvalidArgument(what + " " + must_be_one_of(allowed, *text));
}

std::string ParameterReader::text(std::string_view key, const char* default_value,
                                  std::string_view description) {
  const bool required = default_value == nullptr;
  const std::string fallback = required ? "" : default_value;
  const std::string* text = declare(described(key, fallback, description, ParameterKind::text), required);
  return text == nullptr ? fallback : unescape(*text);
}

std::string ParameterReader::file(std::string_view key, const char* default_value,
                                  std::string_view description) {
  std::string path = text(key, default_value, description);
  if (!path.empty()) files_.push_back({std::string(key), path});
  return path;
}

std::string ParameterReader::word_or_file(std::string_view key, const char* default_value,
                                          const std::vector<std::string_view>& words,
                                          std::string_view description) {
  std::string value = text(key, default_value, description);
  if (!value.empty() && std::find(words.begin(), words.end(), value) == words.end())
    files_.push_back({std::string(key), value});
  return value;
}

std::vector<std::string> ParameterReader::list(std::string_view key, const char* default_value,
                                               std::string_view description) {
  const bool required = default_value == nullptr;
  const std::string fallback = required ? "" : default_value;
  const std::string* given_text =
      declare(described(key, fallback, description, ParameterKind::list), required);
  std::vector<std::string> items;
  for (const std::string_view item : split_unescaped(given_text == nullptr ? fallback : *given_text, '/'))
    items.push_back(unescape(item));
  return items;
}

void ParameterReader::finish() const {
  for (std::size_t i = 0; i < specification_.given.size(); ++i) {
    const std::string& key = specification_.given[i].first;
    const auto declares = [&](const ParameterInfo& info) { return info.key == key; };
    if (std::none_of(declared_.begin(), declared_.end(), declares)) {
      std::vector<std::string> valid;
      for (const ParameterInfo& info : declared_) valid.push_back(info.key);
      throw InvalidArgument(owner() + " has no parameter " + in_quotes(key) +
                            (valid.empty() ? "; it takes none" : nearest_of(key, valid, "it takes")));
    }
    for (std::size_t j = 0; j < i; ++j)
      if (specification_.given[j].first == key) throw InvalidArgument(shown(key) + " is given twice");
  }
}

}  // namespace morsel::core
