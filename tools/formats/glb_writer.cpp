#include "morsel/tools/formats/glb_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/version.h"

namespace morsel::tools {
namespace {

// Names of the specification (Khronos, glTF 2.0, sections 3.6 and 5).
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kPositionBytes = 12, kNormalBytes = 12, kColorBytes = 8;

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

/// Where positions are: position = scale · written + center.
struct Frame {
  core::Point center = core::Point::Zero();
  double scale = 1;

  Eigen::Vector3f written(const core::Point& p) const { return ((p - center) / scale).cast<float>(); }
};

Frame frame_of(const GlbPart& part) {
  core::Point low = part.positions.front();
  core::Point high = low;
  for (const core::Point& p : part.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Frame frame{low / 2 + high / 2, 1};
  const double reach = (high / 2 - low / 2).cwiseAbs().maxCoeff();
  // Sizes whose squares single precision holds are kept.
  if (reach > 0 && (reach < 1e-15 || reach > 1e15)) frame.scale = reach;
  return frame;
}

/// The bytes of the binary chunk, little-endian whatever the machine is, a part at a time.
class GlbBytes {
 public:
  explicit GlbBytes(core::FileWriter& file) : file_(file) {}
  GlbBytes(const GlbBytes&) = delete;
  GlbBytes& operator=(const GlbBytes&) = delete;

  template <class T>
  void write(T value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    if (size_ + bytes.size() > buffer_.size()) flush();
    std::memcpy(buffer_.data() + size_, bytes.data(), bytes.size());
    size_ += bytes.size();
  }
  void write(const Eigen::Vector3f& v) {
    for (int axis = 0; axis < 3; ++axis) write(v[axis]);
  }
  void flush() {
    core::throw_if_stopped();
    file_.write_bytes(buffer_.data(), size_);
    size_ = 0;
  }

 private:
  core::FileWriter& file_;
  std::array<char, 1 << 15> buffer_;
  std::size_t size_ = 0;
};

/// The head of the file: what lies where in the binary chunk, and how it is shown.
class GlbHead {
 public:
  GlbHead(const Frame& frame, const std::string& provenance) : frame_(frame) {
    Json asset = {{"version", "2.0"}, {"generator", std::string("morsel ") + kVersion}};
    asset["extras"]["provenance"] = Json::parse(provenance);
    document_["asset"] = std::move(asset);
    document_["scene"] = 0;
    Json scene;
    scene["nodes"] = Json::array({0});
    document_["scenes"] = Json::array({std::move(scene)});
    Json root = {{"name", "morsel"}, {"children", Json::array()}};
    if (frame.center != core::Point::Zero())
      root["translation"] = Json::array({frame.center[0], frame.center[1], frame.center[2]});
    if (frame.scale != 1) root["scale"] = Json::array({frame.scale, frame.scale, frame.scale});
    document_["nodes"] = Json::array({std::move(root)});
    for (const char* list : {"meshes", "materials", "accessors", "bufferViews"})
      document_[list] = Json::array();
  }

  void add(const GlbPart& part) {
    const std::size_t count = part.positions.size();
    Json attributes = {{"POSITION", add_positions(part)},
                       {"NORMAL", add_accessor(count, kNormalBytes, kFloat, "VEC3", kArrayBuffer)}};
    if (!part.colors.empty()) {
      attributes["COLOR_0"] = add_accessor(count, kColorBytes, kUnsignedShort, "VEC4", kArrayBuffer);
      document_["accessors"].back()["normalized"] = true;
    }
    const std::size_t indices = add_accessor(3 * part.triangles.size(), sizeof(std::uint32_t), kUnsignedInt,
                                             "SCALAR", kElementArrayBuffer);
    const bool one_color = part.colors.empty();
    const auto channel = [&](int i) { return one_color ? std::clamp(part.color[i], 0.f, 1.f) : 1.f; };
    Json material = {{"name", part.name}, {"doubleSided", true}};
    material["pbrMetallicRoughness"] = {
        {"baseColorFactor", Json::array({channel(0), channel(1), channel(2), 1})},
        {"metallicFactor", 0},
        {"roughnessFactor", 0.7}};
    document_["materials"].push_back(std::move(material));
    Json primitive = {{"attributes", std::move(attributes)},
                      {"indices", indices},
                      {"material", document_["materials"].size() - 1}};
    Json mesh = {{"name", part.name}};
    mesh["primitives"] = Json::array({std::move(primitive)});
    document_["meshes"].push_back(std::move(mesh));
    document_["nodes"][0]["children"].push_back(document_["nodes"].size());
    document_["nodes"].push_back({{"name", part.name}, {"mesh", document_["meshes"].size() - 1}});
  }

  std::size_t binary_size() const { return size_; }
  /// Padded with spaces.
  std::string text() {
    document_["buffers"] = Json::array({Json::object({{"byteLength", size_}})});
    std::string text = document_.dump(-1, ' ', true, Json::error_handler_t::replace);
    text.resize(padded(text.size()), ' ');
    return text;
  }

 private:
  std::size_t add_positions(const GlbPart& part) {
    Eigen::Vector3f low = frame_.written(part.positions.front());
    Eigen::Vector3f high = low;
    for (const core::Point& p : part.positions) {
      const Eigen::Vector3f written = frame_.written(p);
      low = low.cwiseMin(written);
      high = high.cwiseMax(written);
    }
    const std::size_t place =
        add_accessor(part.positions.size(), kPositionBytes, kFloat, "VEC3", kArrayBuffer);
    Json& accessor = document_["accessors"].back();
    accessor["min"] = Json::array({low[0], low[1], low[2]});
    accessor["max"] = Json::array({high[0], high[1], high[2]});
    return place;
  }

  /// `bytes`: of an element. All are multiples of 4, so that each view begins at one.
  std::size_t add_accessor(std::size_t count, std::size_t bytes, int component, const char* type,
                           int target) {
    document_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", size_}, {"byteLength", count * bytes}, {"target", target}});
    size_ += count * bytes;
    document_["accessors"].push_back({{"bufferView", document_["bufferViews"].size() - 1},
                                      {"componentType", component},
                                      {"count", count},
                                      {"type", type}});
    return document_["accessors"].size() - 1;
  }

  const Frame& frame_;
  Json document_;
  std::size_t size_ = 0;
};

void write_part(GlbBytes& bytes, const GlbPart& part, const Frame& frame) {
  for (const core::Point& p : part.positions) bytes.write(frame.written(p));
  for (const core::Point& normal : part.normals) {
    const double length = normal.norm();
    // Every normal is to have unit length.
    bytes.write(length > 0 ? Eigen::Vector3f((normal / length).cast<float>()) : Eigen::Vector3f(0, 0, 1));
  }
  for (const Eigen::Vector3f& color : part.colors) {
    constexpr float kMost = std::numeric_limits<std::uint16_t>::max();
    for (int i = 0; i < 3; ++i)
      bytes.write(static_cast<std::uint16_t>(std::lround(std::clamp(color[i], 0.f, 1.f) * kMost)));
    bytes.write(std::numeric_limits<std::uint16_t>::max());
  }
  for (const core::Triangle& triangle : part.triangles)
    for (const core::Index v : triangle) bytes.write(std::uint32_t{v});
}

}  // namespace

void write_glb(const core::FileTarget& target, const std::vector<GlbPart>& parts,
               const std::string& provenance, core::Sync sync) {
  std::vector<const GlbPart*> shown;
  for (const GlbPart& part : parts)
    if (!part.triangles.empty()) shown.push_back(&part);
  if (shown.empty()) throw core::InvalidArgument("a GLB file needs a triangle");
  const Frame frame = frame_of(*shown.front());
  GlbHead head(frame, provenance);
  for (const GlbPart* part : shown) head.add(*part);
  const std::string text = head.text();
  constexpr std::size_t kFileHead = 12, kChunkHead = 8;
  const std::size_t size = kFileHead + kChunkHead + text.size() + kChunkHead + head.binary_size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw core::WriteFailed("a GLB file holds less than 4 GiB, and this one would have " +
                            std::to_string(size) + " bytes; .ply and .vtp files may be larger");

  core::FileWriter file(target, sync);
  GlbBytes bytes(file);
  for (const std::uint32_t word : {kMagic, std::uint32_t{2}, static_cast<std::uint32_t>(size),
                                   static_cast<std::uint32_t>(text.size()), kJsonChunk})
    bytes.write(word);
  bytes.flush();
  file.write(text);
  bytes.write(static_cast<std::uint32_t>(head.binary_size()));
  bytes.write(kBinaryChunk);
  for (const GlbPart* part : shown) write_part(bytes, *part, frame);
  bytes.flush();
  file.commit();
}

}  // namespace morsel::tools
