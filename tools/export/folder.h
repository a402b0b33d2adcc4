#pragma once
/// The folder that files are exported to.

#include <filesystem>
#include <map>
#include <string>

namespace morsel::tools {

/// Makes the folder, and those it is in, if it is not there. Throws WriteFailed if that cannot be done.
void make_folder(const std::filesystem::path& folder);

/// The same, and whether files can be written in it: to be asked before long work.
void make_writable_folder(const std::filesystem::path& folder);

/// File names for what may have the same name: NAME, then NAME-2, and so on.
class FileNames {
 public:
  std::string next(const std::string& name);

 private:
  std::map<std::string, int> uses_;
};

}  // namespace morsel::tools
