#include "morsel/core/io/made_folders.h"

#include <unistd.h>

namespace morsel::core {

namespace fs = std::filesystem;

std::error_code MadeFolders::make(const fs::path& folder) {
  std::error_code error;
  made_.clear();
  // "a/b/" is the folder "a/b".
  for (fs::path at = folder.has_filename() ? folder : folder.parent_path();
       !at.empty() && !fs::exists(at, error); at = at.parent_path())
    made_.push_back(at);
  if (!made_.empty()) fs::create_directories(made_.front(), error);
  return error;
}

void MadeFolders::remove() noexcept {
  for (const fs::path& folder : made_)
    if (::rmdir(folder.c_str()) != 0) return;
}

}  // namespace morsel::core
