#include "morsel/tools/report/input_files.h"

#include <filesystem>
#include <map>

#include "morsel/core/specification.h"
#include "morsel/tools/registry/registry.h"

namespace morsel::tools {

std::vector<HashedFile> input_files(const std::vector<std::string>& fields) {
  std::map<std::string, std::string> hashes;
  for (const std::string& field : fields) {
    const std::string file_key = make_function(field).file_key;
    for (const auto& [key, raw] : core::parse_specification(field, "--field").given)
      if (const std::string value = core::unescape(raw);
          key == file_key && !hashes.contains(value) && std::filesystem::is_regular_file(value))
        hashes[value] = sha256_of_file(value);
  }
  std::vector<HashedFile> files;
  files.reserve(hashes.size());
  for (const auto& [path, hash] : hashes) files.push_back({path, hash});
  return files;
}

Json files_section(const std::vector<HashedFile>& files) {
  Json list = Json::array();
  for (const HashedFile& file : files) list.push_back({{"path", file.path}, {"sha256", file.sha256}});
  return list;
}

}  // namespace morsel::tools
