#pragma once
/// The layout of a batch's folder of results.

#include <filesystem>
#include <string>
#include <utility>

namespace morsel::tools::batch {

/// Paths of the results; nothing is created. `name` is a mesh's within its collection. Without a
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
  /// Incomplete files are in folders in this one.
  std::filesystem::path work() const { return root_ / "work"; }

  /// Why results of this mesh cannot have files here, such as a name that is too long for the file system
  /// with its ending; empty if they can. Queries the file system of the folder, or of the nearest existing
  /// one around it.
  std::string refusal(const std::string& name) const;

 private:
  std::filesystem::path file(const char* folder, const std::string& name, const std::string& ending) const {
    return root_ / folder / (name + ending);
  }
  std::filesystem::path root_;
};

}  // namespace morsel::tools::batch
