#include "morsel/tools/results/file_place.h"

#include <sys/stat.h>

#include <system_error>
#include <tuple>

#include "morsel/core/io/temporary_file.h"

namespace morsel::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as the system has it

/// `links`: how many may still be followed.
FilePlace place_of(const fs::path& path, int links) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0)
    return {status.st_dev, status.st_ino, "", !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)};
  std::error_code error;
  // A link to what is not there yet: writing makes the file that it leads to.
  if (links > 0 && fs::is_symlink(fs::symlink_status(path, error)))
    return place_of(path.parent_path() / fs::read_symlink(path, error), links - 1);
  fs::path parent = path.has_filename() ? path.parent_path() : path.parent_path().parent_path();
  const fs::path name = path.has_filename() ? path.filename() : path.parent_path().filename();
  if (parent.empty()) parent = path.is_absolute() ? "/" : ".";
  if (name.empty() || parent == path) return {0, 0, path.string()};
  FilePlace place = place_of(parent, links);
  if (name == "..")
    place.rest = fs::path(place.rest).parent_path().string();
  else if (name != ".")
    place.rest = (fs::path(place.rest) / name).string();
  return place;
}

}  // namespace

bool operator<(const FilePlace& a, const FilePlace& b) {
  return std::tie(a.device, a.inode, a.rest) < std::tie(b.device, b.inode, b.rest);
}

FilePlace file_place(const fs::path& path) {
  FilePlace place = place_of(path, kMostLinks);
  place.is_system = core::is_descriptor_path(path);
  return place;
}

FilePlace file_place(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return {0, 0, "", true, true};
  return {status.st_dev, status.st_ino, "", !S_ISREG(status.st_mode), true};
}

bool is_in(const fs::path& path, const fs::path& folder) {
  const FilePlace outer = file_place(folder);
  std::error_code error;
  fs::path at = fs::weakly_canonical(path, error);
  if (error) at = fs::absolute(path, error).lexically_normal();
  for (;;) {
    if (file_place(at) == outer) return true;
    const fs::path parent = at.parent_path();
    if (parent == at || parent.empty()) return false;
    at = parent;
  }
}

}  // namespace morsel::tools
