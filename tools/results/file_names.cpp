#include "morsel/tools/results/file_names.h"

namespace morsel::tools {

std::string FileNames::next(const std::string& name) {
  const int use = ++uses_[name];
  return use == 1 ? name : name + "-" + std::to_string(use);
}

}  // namespace morsel::tools
