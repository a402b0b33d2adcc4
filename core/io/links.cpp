#include "morsel/core/io/links.h"

#include <system_error>

namespace morsel::core {

namespace fs = std::filesystem;

fs::path followed(fs::path path) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(path, error); ++links)
    path = path.parent_path() / fs::read_symlink(path);
  return path;
}

}  // namespace morsel::core
