#include "morsel/tools/report/output_check.h"

#include <optional>

#include "morsel/core/error.h"
#include "morsel/core/io/links.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/results/file_list.h"

namespace morsel::tools {

void RunFiles::add(std::vector<Named>& list, const std::string& option, const std::filesystem::path& path) {
  if (!path.empty()) list.push_back({option, path, file_place(path)});
}

RunFiles& RunFiles::reads(const std::string& option, const std::filesystem::path& file) {
  add(inputs_, option, file);
  return *this;
}

RunFiles& RunFiles::reads_mesh(const std::filesystem::path& mesh, const std::string& format) {
  // Standard input may be a file, which is not to be replaced either.
  return mesh == "-" ? reads("MESH", "/dev/stdin") : reads_mesh_file("MESH", mesh, format);
}

RunFiles& RunFiles::reads_mask(const core::BuildOptions& build) {
  return build.mask ? reads("--mask", build.mask->file) : *this;
}

RunFiles& RunFiles::reads_mesh_file(const std::string& option, const std::filesystem::path& file,
                                    const std::string& format) {
  std::optional<core::MeshFormat> given;
  if (!format.empty()) given = core::mesh_format_named(format);
  for (const std::filesystem::path& companion : core::companion_files(file, given))
    reads("a buffer of " + option, companion);
  return reads(option, file);
}

RunFiles& RunFiles::reads_of_field(const std::string& specification, const std::string& option,
                                   const Registry& registry) {
  for (const auto& [key, file] : named_files(specification, registry)) add(inputs_, option + " " + key, file);
  return *this;
}

RunFiles& RunFiles::reads_folder(const std::string& option, const std::filesystem::path& folder) {
  add(input_folders_, option, folder);
  return *this;
}

RunFiles& RunFiles::writes(const std::string& option, const core::FileTarget& target) {
  if (target.is_open_file())  // which may be a file that is read, too
    outputs_.push_back({option, target.path, file_place(target.descriptor), true});
  else
    add(outputs_, option, target.path);
  return *this;
}

RunFiles& RunFiles::writes_document(const std::string& option, const core::FileTarget& target) {
  return writes_no_mesh(option, target);
}

RunFiles& RunFiles::writes_no_mesh(const std::string& option, const core::FileTarget& target) {
  if (!target.is_open_file()) add(no_meshes_, option, target.path);
  return writes(option, target);
}

RunFiles& RunFiles::fills(const std::string& option, const std::filesystem::path& folder) {
  add(folders_, option, folder);
  return *this;
}

void RunFiles::refuse_lists() const {
  for (const Named& output : outputs_)
    if (!output.is_open_file && core::followed(output.path).filename() == FileList::kName)
      throw core::InvalidArgument(output.text() +
                                  " is the list of files of a folder of results; it is not written to");
}

void RunFiles::check() const {
  std::vector<Named> all = outputs_;
  all.insert(all.end(), folders_.begin(), folders_.end());
  refuse_lists();
  for (const Named& output : all)
    for (const Named& input : inputs_)
      if (output.place == input.place && !output.place.is_device)
        throw core::InvalidArgument("the output " + output.text() + " is the file that is read as " +
                                    input.text() + "; give another name");
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      if (all[i].place == all[j].place && !all[i].place.is_device &&
          !(all[i].place.is_system && all[j].place.is_system))
        throw core::InvalidArgument("the outputs " + all[i].text() + " and " + all[j].text() +
                                    " are one file; give another name");
  for (const Named& folder : folders_)
    for (const Named& input : input_folders_)
      if (is_in(folder.path, input.path) || is_in(input.path, folder.path))
        throw core::InvalidArgument(
            "the folder of results " + folder.text() + " and " + input.text() +
            ", which is read, are one or lie in one another; choose a folder elsewhere");
  for (const Named& output : no_meshes_)
    if (core::has_mesh_extension(output.path))
      throw core::InvalidArgument("the output " + output.text() + " is no mesh and is not written to " +
                                  core::mesh_extensions() + "; give another name");
}

std::vector<std::filesystem::path> RunFiles::outputs() const {
  std::vector<std::filesystem::path> paths;
  for (const Named& output : outputs_)
    if (!output.is_open_file) paths.push_back(output.path);
  return paths;
}

}  // namespace morsel::tools
