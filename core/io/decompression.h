#pragma once
/// Decompression in memory: gzip, xz and zstd, told by their first bytes. Internal.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "morsel/core/parallel/progress.h"

namespace morsel::core {

enum class Compression { none, gzip, xz, zstd };

/// By the first bytes.
Compression compression_of(std::string_view bytes);

/// How much may come out: `least` bytes, or `ratio` times the compressed size if that is more. A small file
/// that expands beyond it is no mesh but an attack on memory: meshes as text compress to a tenth, regular
/// ones in xz to a hundredth.
struct DecompressionLimit {
  std::size_t least = std::size_t{256} << 20;
  std::size_t ratio = 250;

  std::size_t for_size(std::size_t compressed) const {
    return compressed > SIZE_MAX / ratio ? SIZE_MAX : compressed * ratio > least ? compressed * ratio : least;
  }
};

/// What the compressed parts of one file may still become in memory, as numbers: all of them together as much
/// as DecompressionLimit has for the file's size.
class DecompressionBudget {
 public:
  explicit DecompressionBudget(std::size_t file_size, const DecompressionLimit& limit = {})
      : file_size_(file_size), most_(limit.for_size(file_size)), left_(most_) {}

  /// Takes `count` times `size` bytes for `what`, before they are allocated. Throws BadInput, which names
  /// `file`, if there are not as many left.
  void take(std::uint64_t count, std::uint64_t size, const std::string& file, const std::string& what);

 private:
  std::size_t file_size_;
  std::size_t most_;
  std::size_t left_;
};

/// Bytes in memory that grow without being copied where the system can move pages, and are not set to 0
/// first.
class GrowingBytes {
 public:
  std::string_view view() const { return {bytes_.get(), size_}; }
  std::size_t size() const { return size_; }
  /// `more` bytes behind those that are there, to be written to. Throws std::bad_alloc.
  char* room_for(std::size_t more);
  /// The first `count` of them were written.
  void wrote(std::size_t count) { size_ += count; }

 private:
  struct Free {
    void operator()(char* bytes) const { std::free(bytes); }
  };
  std::unique_ptr<char, Free> bytes_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// All members (gzip), streams (xz) or frames (zstd) one after another, checksums checked; padding by zero
/// bytes behind them is skipped. Throws BadInput, which names `file`, if the data are truncated, damaged,
/// followed by anything else, or expand beyond the limit; InvalidArgument in a library without the part
/// FORMATS. Memory: twice what comes out, and for xz and zstd at most 256 MiB of dictionary. Reports progress
/// and checks for cancellation at each megabyte that comes out.
GrowingBytes decompress(std::string_view bytes, Compression kind, const std::string& file,
                        const Progress& progress, const DecompressionLimit& limit = {});

}  // namespace morsel::core
