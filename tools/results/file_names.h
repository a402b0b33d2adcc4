#pragma once
/// Names of files that are exported to one folder.

#include <map>
#include <string>

namespace morsel::tools {

/// Distinct file names for equal names: NAME, then NAME-2, and so on. A NAME of more than 200 bytes is cut,
/// so that there is room for endings.
class FileNames {
 public:
  std::string next(const std::string& name);

 private:
  std::map<std::string, int> uses_;
};

}  // namespace morsel::tools
