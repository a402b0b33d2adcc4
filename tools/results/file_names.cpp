#include "morsel/tools/results/file_names.h"

#include <algorithm>
#include <cstddef>

namespace morsel::tools {

namespace {

constexpr std::size_t kLongest = 200;  // file systems allow 255

std::string shortened(const std::string& name) {
  std::size_t size = std::min(name.size(), kLongest);
  while (size > 0 && size < name.size() && (static_cast<unsigned char>(name[size]) & 0xC0) == 0x80)
    --size;  // not within a character
  return name.substr(0, size);
}

}  // namespace

std::string FileNames::next(const std::string& whole) {
  const std::string name = shortened(whole);
  const int use = ++uses_[name];
  return use == 1 ? name : name + "-" + std::to_string(use);
}

}  // namespace morsel::tools
