#include "morsel/tools/export/folder.h"

#include <system_error>

#include "morsel/core/error.h"

namespace morsel::tools {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw core::WriteFailed("cannot make the folder " + folder.string() +
                            (error ? ": " + error.message() : ": a file of that name is there"));
}

std::string FileNames::next(const std::string& name) {
  const int use = ++uses_[name];
  return use == 1 ? name : name + "-" + std::to_string(use);
}

}  // namespace morsel::tools
