#pragma once
/// Writes a JSON document piece by piece, so that a million items never stand in memory together.

#include <nlohmann/json.hpp>
#include <ostream>
#include <string_view>
#include <vector>

namespace morsel::tools {

using Json = nlohmann::ordered_json;

/// Two-space indentation; values are whole (small) JSON values, written on one line where they are `compact`.
/// The caller keeps the document well-formed: keys in objects, none in arrays, every begin with its end.
class JsonStream {
 public:
  explicit JsonStream(std::ostream& out) : out_(out) {}

  void begin_object(std::string_view key = {}) { begin(key, '{'); }
  void begin_array(std::string_view key = {}) { begin(key, '['); }
  void end_object() { end('}'); }
  void end_array() { end(']'); }
  /// A member of the current object.
  void member(std::string_view key, const Json& value);
  /// An element of the current array, on one line.
  void element(const Json& value);

 private:
  void begin(std::string_view key, char bracket);
  void end(char bracket);
  void next_item(std::string_view key);

  std::ostream& out_;
  std::vector<bool> has_items_;
};

}  // namespace morsel::tools
