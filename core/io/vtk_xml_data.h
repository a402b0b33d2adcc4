#pragma once
/// The numbers of VTK's XML files: text, base64 or raw bytes, compressed by zlib or not. Internal.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/vtk_surface.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core::vtk {

/// How all arrays of a file are encoded.
struct XmlEncoding {
  bool swap = false;         ///< numbers are in the other byte order than this machine's
  bool wide_header = false;  ///< lengths before binary data have 64 bits, not 32
  bool compressed = false;
};

/// Bytes of binary data, raw or in base64, one after the other. A padded end of one base64 text may lie
/// before the next one.
class ByteStream {
 public:
  ByteStream(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

  /// Appends `count` bytes to `out`, of which there are at most room(); false if there are fewer, or if they
  /// are no base64.
  bool read(std::size_t count, std::string& out);
  /// The bytes that are left, or more.
  std::size_t room() const { return is_base64_ ? text_.size() / 4 * 3 + 3 + pending_count_ : text_.size(); }
  /// Characters that are left, without white space before them.
  std::string_view rest();
  bool at_end() { return pending_count_ == 0 && rest().empty(); }

 private:
  bool next_group();

  std::string_view text_;
  bool is_base64_;
  char pending_[3] = {};  // decoded, and not yet read
  std::size_t pending_count_ = 0;
};

/// The bytes of one array, which `stream` is at the start of. Throws BadInput, naming the file and the array
/// as `what`, if they are damaged. Lengths in the data are compared with the length of the stream first; of
/// compressed data with what zlib can make of it. `check` is called with the number of bytes that come out
/// before they are allocated, and throws if it is wrong.
std::string read_block(ByteStream& stream, const XmlEncoding& encoding, const std::string& file,
                       const std::string& what, const std::function<void(std::uint64_t)>& check,
                       const Progress& progress);

}  // namespace morsel::core::vtk
