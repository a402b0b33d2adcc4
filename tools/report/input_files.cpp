#include "morsel/tools/report/input_files.h"

#include <filesystem>
#include <map>

#include "morsel/core/specification.h"
#include "morsel/tools/report/sha256.h"

namespace morsel::tools {

Json input_files(const std::vector<std::string>& specifications) {
  std::map<std::string, std::string> hashes;
  for (const std::string& specification : specifications)
    for (const core::Specification& step : core::parse_chain(specification, "--method"))
      for (const auto& [key, raw] : step.given)
        if (const std::string value = core::unescape(raw);
            !hashes.contains(value) && std::filesystem::is_regular_file(value))
          hashes[value] = sha256_of_file(value);
  Json files = Json::array();
  for (const auto& [path, hash] : hashes) files.push_back({{"path", path}, {"sha256", hash}});
  return files;
}

}  // namespace morsel::tools
