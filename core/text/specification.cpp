#include "morsel/core/text/specification.h"

#include "morsel/core/error.h"

namespace morsel::core {
namespace {

constexpr std::string_view kSpecial = ",:+=/\\";

/// Position of the first `separator` without a backslash before it, npos if none.
std::size_t find_unescaped(std::string_view raw, char separator) {
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] == '\\') {
      ++i;
    } else if (raw[i] == separator) {
      return i;
    }
  }
  return std::string_view::npos;
}

Specification parse_link(std::string_view link, std::string_view text, std::string_view what) {
  const auto fail = [&](const std::string& why) {
    return InvalidArgument(std::string(what) + " \"" + std::string(text) + "\" " + why +
                           "; it is written name or name:key=value,key=value");
  };
  Specification result;
  const std::size_t colon = find_unescaped(link, ':');
  result.name = unescape(link.substr(0, colon));
  if (result.name.empty()) throw fail("has an empty name");
  if (colon == std::string_view::npos) return result;
  for (const std::string_view entry : split_unescaped(link.substr(colon + 1), ',')) {
    const std::size_t equals = find_unescaped(entry, '=');
    if (equals == std::string_view::npos)
      throw fail("has \"" + std::string(entry) + "\" where key=value is expected");
    if (equals == 0) throw fail("has an empty key");
    result.given.emplace_back(unescape(entry.substr(0, equals)), std::string(entry.substr(equals + 1)));
  }
  return result;
}

}  // namespace

std::vector<std::string_view> split_unescaped(std::string_view raw, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = find_unescaped(raw, separator);
    parts.push_back(raw.substr(0, end));
    if (end == std::string_view::npos) return parts;
    raw.remove_prefix(end + 1);
  }
}

std::string unescape(std::string_view raw) {
  std::string text;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] == '\\' && i + 1 < raw.size()) ++i;
    text += raw[i];
  }
  return text;
}

std::string escape(std::string_view text) {
  std::string raw;
  for (const char c : text) {
    if (kSpecial.find(c) != std::string_view::npos) raw += '\\';
    raw += c;
  }
  return raw;
}

std::vector<Specification> parse_chain(std::string_view text, std::string_view what) {
  std::vector<Specification> chain;
  for (const std::string_view link : split_unescaped(text, '+'))
    chain.push_back(parse_link(link, text, what));
  return chain;
}

std::string to_string(const Specification& specification) {
  std::string text = escape(specification.name);
  char separator = ':';
  for (const auto& [key, raw] : specification.given) {
    text += separator + escape(key) + '=' + raw;
    separator = ',';
  }
  return text;
}

std::string to_string(const std::vector<Specification>& chain) {
  std::string text;
  for (const Specification& link : chain) text += (text.empty() ? "" : "+") + to_string(link);
  return text;
}

Specification parse_specification(std::string_view text, std::string_view what) {
  std::vector<Specification> chain = parse_chain(text, what);
  if (chain.size() > 1)
    throw InvalidArgument(std::string(what) + " \"" + std::string(text) +
                          "\" is a chain; only methods can be chained");
  return std::move(chain.front());
}

}  // namespace morsel::core
