#pragma once
/// A folder for the files of one test.

#include <filesystem>
#include <string>
#include <string_view>

namespace morsel::test {

/// A new, empty folder that is removed with all that is in it when this goes out of scope.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  /// Makes a file of these bytes in the folder, or in one in it.
  std::filesystem::path file(std::string_view name, std::string_view bytes = {}) const;

 private:
  std::filesystem::path path_;
};

/// All bytes of a file.
std::string contents(const std::filesystem::path& path);

}  // namespace morsel::test
