#pragma once
/// The files of a folder of results, and how they come to be there.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace morsel::tools::batch {

/// Where things are; none is made by asking for its path. `name` is a mesh's within its collection.
class OutFolder {
 public:
  explicit OutFolder(std::filesystem::path root) : root_(std::move(root)) {}

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
  std::filesystem::path lock() const { return root_ / "state" / ".lock"; }

 private:
  std::filesystem::path file(const char* folder, const std::string& name, const std::string& ending) const {
    return root_ / folder / (name + ending);
  }
  std::filesystem::path root_;
};

/// A lock on a file (made if it is not there), until it is destroyed or the process ends in any way. Locks nothing on a file system that has no
/// locks. Moved, not copied.
class FileLock {
 public:
  enum class Wait { no, yes };
  /// None if somebody else has it and we do not wait. Throws WriteFailed where the file cannot be made.
  static std::optional<FileLock> take(const std::filesystem::path& file, Wait wait);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  /// Whether there are locks here.
  bool is_held() const { return held_; }

 private:
  FileLock(int file, bool held) : file_(file), held_(held) {}
  int file_;
  bool held_;
};

/// A new folder OUT/work/XXXXXX of one run, which nobody else writes into: not another run on the same meshes, nor what a broken-off one left
/// running elsewhere. Removed at the end with all that is in it, as are those that killed runs left behind at the beginning.
class WorkFolder {
 public:
  /// Throws WriteFailed.
  explicit WorkFolder(const OutFolder& out);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  const OutFolder& out_;
  std::filesystem::path path_;
  std::optional<FileLock> lock_;  // its being held tells others that the folder is in use
};

/// Removes work folders that nobody has any more. Throws WriteFailed.
void remove_left_work(const OutFolder& out);

/// Moves a file or folder to where nothing is, on the same file system; makes the folder that it comes into. Throws WriteFailed.
void put(const std::filesystem::path& from, const std::filesystem::path& to);
/// The same, if it is there at all.
void put_aside(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace morsel::tools::batch
