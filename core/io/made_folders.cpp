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
    if (at.filename() != "." && at.filename() != "..") made_.push_back(at);  // what has a name of its own
  if (!made_.empty()) fs::create_directories(folder, error);
  return error;
}

void MadeFolders::remove() noexcept {
  for (const fs::path& folder : made_) static_cast<void>(::rmdir(folder.c_str()));
}

}  // namespace morsel::core
