#include "morsel/tools/manual/completions.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "morsel/tools/study/registry.h"

namespace morsel::tools {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

template <class Entries>
std::vector<std::string> names_of(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.emplace_back(entry.name);
  return names;
}

/// What a value can be, where that is a list.
std::vector<std::string> values_of(const Option& option) {
  if (option.kind == ValueKind::function) return names_of(Registry::standard().functions());
  if (option.kind == ValueKind::method) return names_of(Registry::standard().methods());
  return option.choices;
}

constexpr const char* kImplied = "compare";  // of which a file is, where a command is expected
constexpr const char* kHelpText = "Print help for a command";

std::vector<std::string> command_names(const std::deque<Command>& commands) {
  std::vector<std::string> names = {"help"};
  for (const Command& command : commands) names.push_back(command.name);
  return names;
}

/// In single quotes, as the three shells read them.
std::string quoted_word(std::string_view text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// A text up to the end of its first clause, for a list.
std::string brief(const std::string& text) {
  std::size_t end = text.size();
  for (const char* mark : {". ", ": ", "; ", " ("}) end = std::min(end, text.find(mark));
  return text.substr(0, end);
}

std::string brief(const Option& option) {
  return option.in_short.empty() ? brief(option.help) : option.in_short;
}

/// Within the brackets of an argument of zsh's _arguments.
std::string for_zsh(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    escaped += c == '[' || c == ']' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return escaped;
}

std::string zsh_action(const Option& option) {
  if (const auto values = values_of(option); !values.empty()) return "(" + joined(values, " ") + ")";
  return option.kind == ValueKind::path ? "_files" : " ";
}

}  // namespace

std::string bash_completion(const std::deque<Command>& commands) {
  std::string cases;
  const std::string names = joined(command_names(commands), " ");
  for (const Command& command : commands) {
    std::vector<std::string> options = {"--help"};
    std::string values;
    for (const Option& option : command.options()) {
      const std::vector<std::string> listed = values_of(option);
      if (option.is_argument()) {
        if (!listed.empty())
          values += "        *) [[ $word != -* ]] && words=" + quoted_word(joined(listed, " ")) + " ;;\n";
        continue;
      }
      for (const std::string& name : option.all_names()) options.push_back(name);
      if (option.takes_word())
        values.insert(0, "        " + joined(option.all_names(), "|") + ") " +
                             (listed.empty() ? option.kind == ValueKind::path ? "files=1" : "words="
                                             : "words=" + quoted_word(joined(listed, " "))) +
                             "; value=1 ;;\n");
    }
    cases += "    " + command.name + ")\n      options=" + quoted_word(joined(options, " ")) +
             "\n      case $previous in\n" + values + "      esac ;;\n";
  }
  return "# bash completion of morsel\n_morsel() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local names=" +
         quoted_word(names) +
         " command=${COMP_WORDS[1]} options= words= files= value=\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$names\" -- \"$word\"; compgen -f -- \"$word\")\n"
         "    return\n  fi\n"
         "  [[ \" $names \" == *\" $command \"* ]] || command=" +
         kImplied +
         "\n"
         "  case $command in\n    help) words=$names; value=1 ;;\n" +
         cases +
         "  esac\n"
         "  if [[ -z $value && $word == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
         "  elif [[ -n $words ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "  elif [[ -z $value || -n $files ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
         "  fi\n}\n"
         "complete -o filenames -F _morsel morsel\n";
}

std::string zsh_completion(const std::deque<Command>& commands) {
  std::string list = "    " + quoted_word("help:" + std::string(kHelpText)) + "\n";
  std::string cases;
  for (const Command& command : commands) {
    list += "    " + quoted_word(command.name + ":" + brief(command.summary)) + "\n";
    cases += "    " + command.name + ")\n      _arguments '--help[Print help for this command]'";
    for (const Option& option : command.options()) {
      std::string line;
      if (option.is_argument()) {
        line = (option.is_repeated ? "*" : "1") + std::string(":") + option.names + ":" + zsh_action(option);
        cases += " \\\n        " + quoted_word(line);
        continue;
      }
      for (const std::string& name : option.all_names()) {
        line = (option.is_repeated ? "*" : "") + name + "[" + for_zsh(brief(option)) + "]";
        if (option.takes_word()) line += ":" + option.all_names().back().substr(2) + ":" + zsh_action(option);
        cases += " \\\n        " + quoted_word(line);
      }
    }
    cases += " ;;\n";
  }
  return "#compdef morsel\n# zsh completion of morsel\nlocal -a commands\ncommands=(\n" + list +
         ")\nif ((CURRENT == 2)); then\n  _describe command commands\n  _files\nelse\n"
         "  shift words\n  ((CURRENT--))\n"
         "  local name=$words[1]\n"
         "  ((${commands[(I)$name:*]})) || name=" +
         kImplied +
         "\n"
         "  case $name in\n    help) _describe command commands ;;\n" +
         cases + "  esac\nfi\n";
}

std::string fish_completion(const std::deque<Command>& commands) {
  // The command is the second word; completions are offered where it is the one that they are of.
  std::string text =
      "# fish completion of morsel\nfunction __morsel_is\n"
      "  set -l words (commandline -opc)\n"
      "  set -l name $words[2]\n"
      "  if set -q words[2]; and not contains -- $name " +
      joined(command_names(commands), " ") + "\n    set name " + kImplied +
      "\n  end\n  test \"$name\" = \"$argv[1]\"\nend\n";
  const auto offer_name = [&](const std::string& name, const std::string& summary) {
    const std::string end = " -a " + name + " -d " + quoted_word(brief(summary)) + "\n";
    text += "complete -c morsel -n '__morsel_is \"\"'" + end;
    text += "complete -c morsel -n '__morsel_is help' -f" + end;
  };
  offer_name("help", kHelpText);
  for (const Command& command : commands) offer_name(command.name, command.summary);
  for (const Command& command : commands) {
    const std::string begin = "complete -c morsel -n " + quoted_word("__morsel_is " + command.name);
    text += begin + " -l help -d 'Print help for this command'\n";
    for (const Option& option : command.options()) {
      const std::vector<std::string> listed = values_of(option);
      const std::string offered = listed.empty() ? "" : " -f -a " + quoted_word(joined(listed, " "));
      if (option.is_argument()) {
        if (!listed.empty()) text.append(begin).append(offered).append("\n");
        continue;
      }
      text += begin;
      for (const std::string& name : option.all_names())
        text.append(name.starts_with("--") ? " -l " : " -s ")
            .append(name.substr(name.starts_with("--") ? 2 : 1));
      if (option.takes_word()) text += option.kind == ValueKind::path ? " -r" : " -x";
      text.append(offered).append(" -d ").append(quoted_word(brief(option))).append("\n");
    }
  }
  return text;
}

}  // namespace morsel::tools
