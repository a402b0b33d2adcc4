#include "morsel/tools/batch/out_folder.h"

#include <unistd.h>

#include <algorithm>
#include <climits>
#include <string_view>
#include <system_error>

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestEnding = std::string_view(".first.png").size();
constexpr std::size_t kRoomBelow = 256;  // for files in a folder of a mesh, and for "thumbnails/"

/// The longest name that a file may have here.
std::size_t longest_name(fs::path folder) {
  std::error_code error;
  folder = fs::absolute(folder, error);
  for (;; folder = folder.parent_path()) {
    if (const long most = ::pathconf(folder.c_str(), _PC_NAME_MAX); most > 0)
      return static_cast<std::size_t>(most);
    if (folder == folder.parent_path()) return NAME_MAX;
  }
}

}  // namespace

std::string OutFolder::refusal(const std::string& name) const {
  const std::size_t most = longest_name(root_);
  const fs::path parts(name);
  for (const fs::path& part : parts) {
    const std::size_t ending = part == parts.filename() ? kLongestEnding : 0;
    if (part.native().size() + ending > most)
      return "the name " + part.string() + " has " + std::to_string(part.native().size()) +
             " bytes, more than the " + std::to_string(most - ending) +
             " that leave room for the names of its results";
  }
  if (root_.native().size() + name.size() + kLongestEnding + kRoomBelow >= PATH_MAX)
    return "the path of its results would be longer than the system's " + std::to_string(PATH_MAX) + " bytes";
  return "";
}

}  // namespace morsel::tools::batch
