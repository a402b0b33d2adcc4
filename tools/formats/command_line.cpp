#include "morsel/tools/formats/command_line.h"

#include <string_view>

namespace morsel::tools {
namespace {

std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=:,./%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

void add_option(std::vector<std::string>& words, const std::string& name, const std::string& value) {
  if (value.starts_with('-'))
    words.push_back(name + "=" + value);
  else
    words.insert(words.end(), {name, value});
}

void add_words(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

void add_flag(std::vector<std::string>& words, const std::string& name, bool given) {
  if (given) words.push_back(name);
}

}  // namespace morsel::tools
