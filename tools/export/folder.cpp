#include "morsel/tools/export/folder.h"

#include <system_error>

#include "morsel/core/error.h"
#include "morsel/core/file_writer.h"

namespace morsel::tools {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw core::WriteFailed("cannot make the folder " + folder.string() +
                            (error ? ": " + error.message() : ": a file of that name is there"));
}

void make_writable_folder(const std::filesystem::path& folder) {
  make_folder(folder);
  const core::FileWriter probe(folder / "probe");  // never there, as it is not committed
}

std::string FileNames::next(const std::string& name) {
  const int use = ++uses_[name];
  return use == 1 ? name : name + "-" + std::to_string(use);
}

}  // namespace morsel::tools
