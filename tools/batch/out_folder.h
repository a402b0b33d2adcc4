#pragma once
/// Where a batch's results are in its folder.

#include <filesystem>
#include <string>
#include <utility>

namespace morsel::tools::batch {

/// Where things are; none is made by asking for its path. `name` is a mesh's within its collection. Without a
/// root they are paths within the folder, as result_folder.h has them.
class OutFolder {
 public:
  explicit OutFolder(std::filesystem::path root = {}) : root_(std::move(root)) {}

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path report(const std::string& name) const { return file("reports", name, ".json"); }
  std::filesystem::path state(const std::string& name) const { return file("state", name, ".json"); }
  /// `which`: "first" or "last"
  std::filesystem::path thumbnail(const std::string& name, const std::string& which) const {
    return file("thumbnails", name, "." + which + ".png");
  }
  std::filesystem::path page(const std::string& name) const { return file("pages", name, ".html"); }
  /// These two are folders.
  std::filesystem::path figures(const std::string& name) const { return file("figures", name, ""); }
  std::filesystem::path exports(const std::string& name) const { return file("exports", name, ""); }
  /// What is not whole yet is in folders in this one.
  std::filesystem::path work() const { return root_ / "work"; }

  /// Why results of this mesh could have no file here, such as a name that is too long for the file system
  /// with its ending; empty if they could. Asks the system about the folder, or the nearest around it that is
  /// there.
  std::string refusal(const std::string& name) const;

 private:
  std::filesystem::path file(const char* folder, const std::string& name, const std::string& ending) const {
    return root_ / folder / (name + ending);
  }
  std::filesystem::path root_;
};

}  // namespace morsel::tools::batch
