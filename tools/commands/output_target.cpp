#include "morsel/tools/commands/output_target.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <string_view>

#include "morsel/core/error.h"

namespace morsel::tools {
namespace {

bool is_binary(std::string_view format) {
  constexpr std::array<std::string_view, 4> kBinary = {"annot", "glb", "ply", "png"};
  return std::ranges::find(kBinary, format) != kBinary.end();
}

}  // namespace

core::FileTarget output_target(const std::string& path, const Run& run) {
  if (path != kStandardOutput) return path;
  const std::string& format = run.common.standard_output;
  if (is_binary(format) && ::isatty(STDOUT_FILENO) == 1)
    throw core::InvalidArgument("standard output (-) is a terminal, and " + format +
                                " files are binary: redirect it (> FILE." + format + ") or name a file");
  return core::FileTarget::open_file(STDOUT_FILENO, "standard output", "." + format);
}

void show(const std::string& text, const Run& run) {
  if (run.common.standard_output.empty()) std::cout << text;
}

void tell_written(const std::string& what, const core::FileTarget& target, const Run& run) {
  if (!target.is_open_file()) run.console.message(what + ": " + target.path.string());
}

}  // namespace morsel::tools
