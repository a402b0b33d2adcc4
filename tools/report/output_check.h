#pragma once
/// What a run reads and writes, and whether it may: asked before any work.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/tools/results/file_place.h"
#include "morsel/tools/study/registry.h"

namespace morsel::tools {

/// Every file and folder that a run names, with the option of the command line, or the argument in Python,
/// that does ("-o", "MESH"). Empty paths stand for none.
class RunFiles {
 public:
  RunFiles& reads(const std::string& option, const std::filesystem::path& file);
  /// MESH of a command, of which - is standard input, in the format of that name; if empty, that of the
  /// file's name.
  RunFiles& reads_mesh(const std::filesystem::path& mesh, const std::string& format = {});
  /// The file of --mask.
  RunFiles& reads_mask(const core::BuildOptions& build);
  /// The file of a mesh, and those that it names (core::companion_files()).
  RunFiles& reads_mesh_file(const std::string& option, const std::filesystem::path& file,
                            const std::string& format = {});
  /// The files that keys of a Morse function, given by `option`, name.
  RunFiles& reads_of_field(const std::string& specification, const std::string& option = "--field",
                           const Registry& registry = Registry::standard());
  RunFiles& reads_folder(const std::string& option, const std::filesystem::path& folder);
  RunFiles& writes(const std::string& option, const core::FileTarget& target);
  /// A file of a format that is no mesh's: named as a mesh, it could replace one that was meant to be read.
  RunFiles& writes_no_mesh(const std::string& option, const core::FileTarget& target);
  /// The same for a document.
  RunFiles& writes_document(const std::string& option, const core::FileTarget& target);
  /// A folder of results (result_folder.h).
  RunFiles& fills(const std::string& option, const std::filesystem::path& folder);

  /// Throws InvalidArgument where an output is an input, or another output, by identity of the file
  /// (file_place.h); where a folder that is read and one that is filled lie in one another; and where the
  /// name of an output is that of a mesh but its format is not. Devices and pipes may be named any number of
  /// times; two options may fill one folder, and an output file may lie in it.
  void check() const;

  /// Those of writes(), but for open files.
  std::vector<std::filesystem::path> outputs() const;

 private:
  struct Named {
    std::string option;
    std::filesystem::path path;
    FilePlace place;
    bool is_open_file = false;
    std::string text() const { return option + " " + path.string(); }
  };
  /// Of folders of results, also through links.
  void refuse_lists() const;
  static void add(std::vector<Named>& list, const std::string& option, const std::filesystem::path& path);

  std::vector<Named> inputs_, input_folders_, outputs_, folders_, no_meshes_;
};

}  // namespace morsel::tools
