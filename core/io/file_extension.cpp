#include "morsel/core/io/file_extension.h"

#include <algorithm>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/text/ascii_case.h"
#include "morsel/core/text/listed.h"

namespace morsel::core {

std::string file_extension(const std::filesystem::path& path) { return lowered(path.extension().string()); }

std::string checked_extension(const FileTarget& target, std::string_view what,
                              std::initializer_list<std::string_view> allowed) {
  const std::filesystem::path path = target.path.string() + target.format;
  std::string extension = file_extension(path);
  const std::string longer = file_extension(path.stem()) + extension;
  if (std::ranges::find(allowed, longer) != allowed.end()) return longer;
  if (std::ranges::find(allowed, extension) == allowed.end())
    throw InvalidArgument(std::string(what) + " to " +
                          listed(std::vector<std::string>(allowed.begin(), allowed.end()), " or ") +
                          ", not to \"" + path.string() + "\"");
  return extension;
}

}  // namespace morsel::core
