#pragma once
/// Reads JSON documents that may be damaged or malicious: all JSON that the program reads is read by this.

#include <cstddef>
#include <istream>
#include <limits>
#include <string>
#include <string_view>

#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// The limits of a document. Far above what the program writes; low enough that code that handles values
/// recursively or member by member stays safe and linear in the document's size.
struct JsonLimits {
  std::size_t depth = 64;                                       ///< containers around a value
  std::size_t token = std::size_t{16} << 20;                    ///< bytes of a text, a number, white space
  std::size_t members = 512;                                    ///< of one object
  std::size_t bytes = std::numeric_limits<std::size_t>::max();  ///< of the document
};

/// Follows a document while it is read. `depth` is the number of containers around a value.
class JsonFollower {
 public:
  virtual ~JsonFollower() = default;
  /// The key of the next value, which is at `depth`.
  virtual void key(std::size_t /*depth*/, std::string_view /*name*/) {}
  /// An object or an array begins.
  virtual void begin(std::size_t /*depth*/, bool /*is_array*/) {}
  /// A value is complete, scalar or container. Returns false if it is not to be kept in the array that it is
  /// an element of.
  virtual bool end(std::size_t /*depth*/, const Json& /*value*/) { return true; }
};

/// Reads a whole text or stream as one document. All texts in it are valid UTF-8, all numbers finite; if an
/// object has a key twice, the last one counts. Time and memory are linear in its size. Throws
/// BadInput ("NAME is not JSON: …") on what is not JSON or exceeds the limits, and what the follower throws.
Json read_json(std::istream& in, const std::string& name, const JsonLimits& limits = {},
               JsonFollower* follower = nullptr);
Json read_json(std::string_view text, const std::string& name, const JsonLimits& limits = {},
               JsonFollower* follower = nullptr);

}  // namespace morsel::tools
