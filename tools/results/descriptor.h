#pragma once
/// Files and folders by descriptors: operations below a folder that follow no symbolic link.

#include <filesystem>
#include <string>
#include <utility>

namespace morsel::tools {

/// An open file, closed when the object is destroyed. Moved, not copied.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

enum class Missing { tell, make };

/// The folder `relative` (normal, without "..") below the open folder `root`, which messages call `shown`.
/// One that is missing is made, or the result is not open. Throws WriteFailed where a part of it is a
/// symbolic link or not a folder, or the system fails.
Descriptor open_below(int root, const std::filesystem::path& relative, Missing missing,
                      const std::filesystem::path& shown);

/// Removes a file, a link, or a folder with all in it, but nothing behind a link and nothing on another file
/// system. False if something is left.
bool remove_tree(int folder, const std::string& name) noexcept;

/// "cannot write PATH: REASON" as WriteFailed, of errno's value.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error);

}  // namespace morsel::tools
