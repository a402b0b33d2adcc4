#pragma once
/// A folder of results: only files that the program made there are replaced or removed.

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/made_folders.h"
#include "morsel/tools/results/descriptor.h"
#include "morsel/tools/results/file_identity.h"
#include "morsel/tools/results/file_list.h"
#include "morsel/tools/results/file_place.h"

namespace morsel::tools {

/// A folder with a list of the files that were made in it (file_list.h). What is listed may be replaced and
/// removed, and nothing else: another file in the place of a result is refused, even if its name is listed,
/// and no symbolic link below the folder is followed. The folder itself may be reached through links. Runs
/// may share a folder, as may objects of one run.
///
/// Paths are relative to the folder, normal and without ".."; all functions may be called from several
/// threads at once.
class ResultFolder {
 public:
  struct Options {
    std::vector<std::filesystem::path>
        taken;             ///< the run's other outputs, which are not for the folder to replace
    std::stop_token stop;  ///< ends waiting for another run
  };

  /// A folder that is missing is made, an empty one gets a list. Throws InvalidArgument, a sentence that says
  /// what to do, on any other without one, BadInput on a damaged list, WriteFailed where the folder cannot be
  /// made or written into.
  explicit ResultFolder(std::filesystem::path path) : ResultFolder(std::move(path), Options()) {}
  ResultFolder(std::filesystem::path path, Options options);
  /// Removes the list, and the folders that the constructor made, if the list is new, nothing is in it and no
  /// other run has the folder open: a run that failed before its first file leaves nothing.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;
  /// Throws InvalidArgument as the constructor would; makes nothing.
  static void check(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }

  /// Where to write a file, while the object lives; it is listed just before it appears. Throws WriteFailed,
  /// now and then, if an unlisted file or a folder is in its place, or it is one of the outputs `taken`.
  core::FileTarget claim(const std::filesystem::path& file);
  /// Throws as claim(), and makes nothing.
  void check_free(const std::filesystem::path& file);
  /// Throws WriteFailed if something else than a folder, such as a link, is in its place.
  void check_folder(const std::filesystem::path& folder);

  /// While it lives, other runs wait before they list, move or remove anything here.
  class Hold {
   public:
    explicit Hold(ResultFolder& folder);
    ~Hold();
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    ResultFolder& folder_;
  };

  /// Moves a file from a work folder to its place, as by claim().
  void move(const std::filesystem::path& made, const std::filesystem::path& file);
  /// Removes a file, and folders that it leaves empty, if it is listed. Throws WriteFailed.
  void remove(const std::filesystem::path& file);
  /// The listed files in a folder and the folders in it.
  std::vector<std::string> files_in(const std::filesystem::path& folder);

  /// A new folder in the folder `around`, listed, for incomplete files; locked as long as the
  /// object lives, and removed with its content at the end.
  class Work {
   public:
    Work(ResultFolder& folder, const std::filesystem::path& around);
    ~Work();
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

    const std::filesystem::path& relative() const { return relative_; }
    std::filesystem::path path() const { return folder_.path() / relative_; }

   private:
    ResultFolder& folder_;
    std::filesystem::path relative_;
    Descriptor lock_;
  };
  /// Removes the work folders in `around` that ended processes left. Throws WriteFailed.
  void remove_left_work(const std::filesystem::path& around);
  /// Removes a folder in a work folder with all that is in it, as far as that can be done.
  void remove_work(const std::filesystem::path& relative) noexcept;

 private:
  void open();
  void remove_if_unused() noexcept;
  /// The folder that a path is in. Not open if it is missing.
  Descriptor parent_of(const std::filesystem::path& relative, Missing missing) const;
  /// The file in a place if the program made it, none if nothing is there. Throws as claim().
  std::optional<FileIdentity> made_at(const std::filesystem::path& file) const;
  void list(const std::filesystem::path& file, const FileIdentity& made);
  void remove_remade(const std::filesystem::path& work) noexcept;
  bool is_abandoned(const std::filesystem::path& work) const;
  bool remove_listed_work(const std::filesystem::path& around, const std::string& entry);

  std::filesystem::path path_;
  std::set<FilePlace> taken_;
  std::stop_token stop_;
  core::MadeFolders made_;
  Descriptor root_;
  std::recursive_mutex mutex_;
  int holds_ = 0;
  std::optional<FileList> list_;
};

}  // namespace morsel::tools
