#include "morsel/tools/report/input_files.h"

#include <filesystem>
#include <map>
#include <system_error>

namespace morsel::tools {

std::vector<std::pair<std::string, std::string>> named_files(const std::string& field,
                                                             const Registry& registry) {
  std::vector<std::pair<std::string, std::string>> files;
  const NamedFunction function = registry.make_function(field);
  files.reserve(function.files.size());
  for (const core::FileParameter& file : function.files)
    files.emplace_back(function.name + ":" + file.key, file.path);
  return files;
}

std::vector<HashedFile> input_files(const std::vector<std::string>& fields, const Registry& registry) {
  std::map<std::string, std::string> hashes;
  for (const std::string& field : fields)
    for (const auto& [key, path] : named_files(field, registry)) {
      std::error_code error;  // then the function's error is more specific
      if (!hashes.contains(path) && std::filesystem::is_regular_file(path, error))
        hashes[path] = sha256_of_file(path);
    }
  std::vector<HashedFile> files;
  files.reserve(hashes.size());
  for (const auto& [path, hash] : hashes) files.push_back({path, hash});
  return files;
}

std::vector<HashedFile> input_files(const StabilityRequest& request, const Registry& registry) {
  std::vector<std::string> fields = request.fields;
  if (!request.reference_field.empty()) fields.push_back(request.reference_field);
  return input_files(fields, registry);
}

std::vector<HashedFile> hashed_files(const FieldOutcome& field) {
  std::vector<HashedFile> files;
  files.reserve(field.files.size());
  for (const core::FileParameter& file : field.files) files.push_back({file.path, sha256_of_file(file.path)});
  return files;
}

Json files_section(const std::vector<HashedFile>& files) {
  Json list = Json::array();
  for (const HashedFile& file : files) list.push_back({{"path", file.path}, {"sha256", file.sha256}});
  return list;
}

}  // namespace morsel::tools
