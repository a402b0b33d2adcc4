#include "morsel/tools/report/input_files.h"

#include <filesystem>
#include <map>

#include "morsel/core/specification.h"

namespace morsel::tools {

std::vector<HashedFile> input_files(const std::vector<std::string>& specifications) {
  std::map<std::string, std::string> hashes;
  for (const std::string& specification : specifications)
    for (const core::Specification& step : core::parse_chain(specification, "--method"))
      for (const auto& [key, raw] : step.given)
        if (const std::string value = core::unescape(raw);
            !hashes.contains(value) && std::filesystem::is_regular_file(value))
          hashes[value] = sha256_of_file(value);
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
