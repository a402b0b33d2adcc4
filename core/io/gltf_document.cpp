#include "morsel/core/io/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <set>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/file_formats.h"
#include "morsel/core/io/gltf.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

using nlohmann::json;

constexpr int kDeepest = 64;  // of the JSON: tinygltf recurs
constexpr std::size_t kMostValues = std::size_t{1}
                                    << 22;  // of the JSON: a node of two characters takes 500 bytes
constexpr std::size_t kJsonSizeAt = 12, kJsonAt = 20;  // in binary glTF

std::uint32_t load_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Parses the parts that the triangles need, and checks the types of what tinygltf passes over in silence
/// when they are wrong: indices, sizes and transforms.
class JsonFilter {
 public:
  JsonFilter(const std::string& file, const Progress& progress) : file_(file), progress_(progress) {}

  json parse(std::string_view text) {
    try {
      json document = json::parse(text, [this](int depth, json::parse_event_t event, json& value) {
        return keep(depth, event, value);
      });
      if (!document.is_object()) fail_reading(file_, "its JSON is no object");
      return document;
    } catch (const json::exception& error) {
      const std::string_view what = error.what();
      const std::size_t at = what.find("] ");
      fail_reading(file_, "its JSON cannot be read: " +
                              one_line(at == std::string_view::npos ? what : what.substr(at + 2)));
    }
  }

 private:
  bool keep(int depth, json::parse_event_t event, json& value) {
    if ((++steps_ & 0xFFFF) == 0) progress_.update("reading the mesh", 0);
    if (depth > kDeepest)
      fail_reading(file_, "its JSON is nested more than " + std::to_string(kDeepest) + " levels deep");
    switch (event) {
      case json::parse_event_t::key:
        key_ = value.get_ref<const std::string&>();
        if (depth <= unchecked_) unchecked_ = kNowhere;
        return begin_member(depth);
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        count();
        return true;
      case json::parse_event_t::value:
        count();
        if (unchecked_ == kNowhere) check(value);
        return true;
      default:  // the end of an object or an array, within the one at `depth`
        if (depth < unchecked_) unchecked_ = kNowhere;
        return true;
    }
  }

  /// Whether the member that key_ begins is kept. Values in extensions, and in what is not kept, of which
  /// this is told, too, have types of their own.
  bool begin_member(int depth) {
    const bool is_kept = depth == 1 ? is_needed() : key_ != "extras";
    if (unchecked_ == kNowhere && (!is_kept || key_ == "extensions")) unchecked_ = depth;
    return is_kept;
  }

  bool is_needed() const {
    static const std::set<std::string, std::less<>> kNeeded = {
        "asset",     "scene",       "scenes",  "nodes",          "meshes",
        "accessors", "bufferViews", "buffers", "extensionsUsed", "extensionsRequired"};
    return kNeeded.contains(key_);
  }

  void count() {
    if (++values_ > kMostValues)
      fail_reading(file_, "its JSON has more than " + std::to_string(kMostValues) + " values");
  }

  void check(json& value) const {
    static const std::set<std::string, std::less<>> kIndices = {
        "mesh", "indices", "buffer", "bufferView", "children", "nodes", "scene", "mode", "skin", "POSITION"};
    static const std::set<std::string, std::less<>> kSizes = {"byteOffset", "byteLength", "byteStride",
                                                              "count", "componentType"};
    static const std::set<std::string, std::less<>> kNumbers = {"matrix", "rotation", "scale", "translation",
                                                                "weights"};
    const bool is_index = kIndices.contains(key_) || key_.starts_with('_');
    if (is_index || kSizes.contains(key_)) {
      constexpr double kExact = 9007199254740992;  // 2⁵³
      if (value.is_number_float() && value.get<double>() >= 0 && value.get<double>() < kExact &&
          value.get<double>() == std::floor(value.get<double>()))
        value = static_cast<std::uint64_t>(value.get<double>());
      const bool fits =
          value.is_number_unsigned() &&
          value.get<std::uint64_t>() <= (is_index ? std::uint64_t{0x7FFF'FFFF} : std::uint64_t{1} << 53);
      if (!fits)
        fail_reading(file_, "its JSON has " + shown(value.dump(-1, ' ', true)) + " for " + shown(key_) +
                                ", which should be a whole number");
    } else if (kNumbers.contains(key_) && !value.is_number()) {
      fail_reading(file_, "its JSON has " + shown(value.dump(-1, ' ', true)) + " in " + shown(key_) +
                              ", which should be numbers");
    }
  }

  const std::string& file_;
  const Progress& progress_;
  static constexpr int kNowhere = -1;
  std::string key_;
  int unchecked_ = kNowhere;  // the level of the key that this is within, of values that are not checked
  std::size_t steps_ = 0;
  std::size_t values_ = 0;
};

/// The JSON of a file, of which the bytes may end behind it.
std::string_view json_of_head(std::string_view bytes, const std::string& file) {
  if (!bytes.starts_with("glTF")) return bytes;
  if (bytes.size() < kJsonAt) fail_reading(file, "it ends within the header of binary glTF");
  return bytes.substr(kJsonAt, load_u32(bytes, kJsonSizeAt));
}

/// The bytes of a file, of binary glTF those to the end of its JSON: the others may be many.
FileBytes bytes_of_head(const std::filesystem::path& path, const std::string& file) {
  const FileBytes start(path, file, kJsonAt);
  const std::string_view bytes = start.view();
  const bool is_binary = bytes.starts_with("glTF") && bytes.size() == kJsonAt;
  return {path, file, is_binary ? kJsonAt + load_u32(bytes, kJsonSizeAt) : FileBytes::kAll};
}

}  // namespace

std::string one_line(std::string_view message) {
  message = message.substr(0, message.find('\n'));
  std::string line;
  for (const char c : message.substr(0, 160)) line += c >= ' ' && c <= '~' ? c : '?';
  return line;
}

GltfContainer open_gltf(std::string_view bytes, const std::string& file, std::vector<std::string>& warnings) {
  if (!bytes.starts_with("glTF")) return {bytes, std::nullopt};
  if (bytes.size() < 20) fail_reading(file, "it ends within the header of binary glTF");
  const std::uint32_t version = load_u32(bytes, 4);
  if (version != 2) fail_reading(file, "it is binary glTF of version " + std::to_string(version) + ", not 2");
  const std::size_t length = load_u32(bytes, 8);
  if (length > bytes.size())
    fail_reading(file, "it is cut off: its header announces " + std::to_string(length) +
                           " bytes, and it has " + std::to_string(bytes.size()));
  if (length < bytes.size())
    warnings.push_back(std::to_string(bytes.size() - length) +
                       " bytes behind the length that its header announces are not read");
  bytes = bytes.substr(0, length);
  GltfContainer parts;
  for (std::size_t at = 12, chunk = 0; at < length; ++chunk) {
    if (length - at < 8) fail_reading(file, "it ends within the header of chunk " + std::to_string(chunk));
    const std::size_t size = load_u32(bytes, at);
    const std::uint32_t type = load_u32(bytes, at + 4);
    at += 8;
    if (size > length - at)
      fail_reading(file, "its chunk " + std::to_string(chunk) + " announces " + std::to_string(size) +
                             " bytes, and " + std::to_string(length - at) + " are left for it");
    constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    if ((chunk == 0) != (type == kJson))
      fail_reading(file, chunk == 0 ? "its first chunk is not JSON" : "it has two chunks of JSON");
    if (chunk == 0) parts.json = bytes.substr(at, size);
    if (chunk == 1 && type == kBinary) parts.binary = bytes.substr(at, size);
    at += size;
  }
  if (parts.json.empty()) fail_reading(file, "it has no chunk of JSON");
  return parts;
}

nlohmann::json checked_gltf_json(std::string_view text, const std::string& file, const Progress& progress) {
  return JsonFilter(file, progress).parse(text);
}

std::string neighbour_name(const std::string& uri, const std::string& file) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const auto digit = [&](std::size_t at) {
      const auto found =
          at < uri.size() ? std::string_view("0123456789abcdefABCDEF").find(uri[at]) : std::string_view::npos;
      return found == std::string_view::npos ? -1 : static_cast<int>(found < 16 ? found : found - 6);
    };
    if (uri[i] == '%' && digit(i + 1) >= 0 && digit(i + 2) >= 0) {
      name += static_cast<char>(16 * digit(i + 1) + digit(i + 2));
      i += 2;
    } else {
      name += uri[i];
    }
  }
  if (name.empty() || name == "." || name == ".." ||
      name.find_first_of(std::string_view("/\\:\0", 4)) != std::string::npos)
    fail_reading(file, "its buffer is at " + shown(uri) + ": only files in the same folder are read");
  return name;
}

std::vector<std::filesystem::path> gltf_companions(const std::filesystem::path& path) {
  const std::string file = path.string();
  const FileBytes bytes = bytes_of_head(path, file);
  const DecodedBytes decoded(bytes.view(), file);
  std::string_view content = decoded.view();
  std::string converted;
  if (is_utf16(content)) content = converted = utf8_of_utf16(content, file);
  const Progress progress;
  const json document = checked_gltf_json(json_of_head(content, file), file, progress);
  std::vector<std::filesystem::path> companions;
  const auto buffers = document.find("buffers");
  if (buffers == document.end() || !buffers->is_array()) return companions;
  for (const json& buffer : *buffers) {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
    const auto& uri = buffer["uri"].get_ref<const std::string&>();
    if (uri.starts_with("data:")) continue;
    try {
      companions.push_back(path.parent_path() / neighbour_name(uri, file));
    } catch (const BadInput&) {  // it is not read either
    }
  }
  std::ranges::sort(companions);
  companions.erase(std::unique(companions.begin(), companions.end()), companions.end());
  return companions;
}

}  // namespace morsel::core
