// morsel fields, morsel methods: what there is to choose from.

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "morsel/tools/commands/commands.h"
#include "morsel/tools/study/registry.h"

namespace morsel::tools {
namespace {

template <class Entries>
int list(const Entries& entries, const std::string& name,
         std::string (Registry::*describe)(const std::string& name) const) {
  if (!name.empty()) {
    std::cout << (Registry::standard().*describe)(name);
    return kDone;
  }
  std::size_t width = 0;
  for (const auto& entry : entries) width = std::max(width, entry.name.size());
  for (const auto& entry : entries)
    std::cout << entry.name << std::string(width + 2 - entry.name.size(), ' ') << entry.summary << "\n";
  return kDone;
}

}  // namespace

void add_catalogue(Program& program) {
  const auto name = std::make_shared<std::string>();
  Command& fields = program.add("fields", "List the Morse functions, or the keys of one");
  fields.text("NAME", *name, "Of one of them: its keys, their defaults and meanings").is_function();
  fields.examples = {{"fields", "the names, a line each"},
                     {"fields mean-curvature", "its keys, to be written as mean-curvature:scale=8eps"}};
  fields.action = [name](Console&) {
    return list(Registry::standard().functions(), *name, &Registry::describe_function);
  };

  Command& all = program.add("methods", "List the methods, or the keys of one");
  all.text("NAME", *name, "Of one of them: its keys, their defaults and meanings").is_method();
  all.examples = {{"methods", "the names, a line each"},
                  {"methods salient", "its keys, to be written as salient:iterations=5,sigma=4eps"}};
  all.action = [name](Console&) {
    return list(Registry::standard().methods(), *name, &Registry::describe_method);
  };
}

}  // namespace morsel::tools
