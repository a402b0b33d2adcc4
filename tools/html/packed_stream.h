#pragma once
/// Bytes of a page, compressed and written as text.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "morsel/core/io/file_writer.h"

namespace morsel::tools::html {

/// Writes its input at once to a file, deflated (zlib's format, RFC 1950) and in base64. The
/// same input gives the same text. Throws WriteFailed, and std::bad_alloc.
class PackedStream {
 public:
  /// Refers to `file`, which must not be written to otherwise before finish().
  explicit PackedStream(core::FileWriter& file);
  ~PackedStream();
  PackedStream(const PackedStream&) = delete;
  PackedStream& operator=(const PackedStream&) = delete;

  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Writes what is buffered and ends the stream. Nothing may be written afterwards.
  void finish();
  /// Bytes taken so far, before they were compressed.
  std::uint64_t size() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace morsel::tools::html
