// glTF 2.0 by tinygltf, which is compiled here: without pictures and files, and in a namespace of its own, so
// that programs may have another copy. It reads the structure of the JSON alone, which gltf_document.h checks
// first. What else it takes on trust is checked here: buffers, and every accessor.

#define tinygltf morsel_tinygltf
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <fstream>  // which its writers need

#include <tiny_gltf.h>
#undef tinygltf

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/file_formats.h"
#include "morsel/core/io/gltf.h"
#include "morsel/core/io/gltf_document.h"
#include "morsel/core/text/base64.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

namespace gltf = morsel_tinygltf;
using nlohmann::json;
static_assert(std::endian::native == std::endian::little, "numbers are read as they are in the file");

constexpr std::size_t kRepeated = std::size_t{1}
                                  << 23;  // vertices, corners and values, whatever the file's length
constexpr std::size_t kPerByte = 16;      // and for each of its bytes

/// "2 primitives are", "1 primitive is".
std::string counted_as(std::size_t count, const std::string& name) {
  return std::to_string(count) + " " + name + (count == 1 ? " is" : "s are");
}

/// The buffers, each loaded when it is first used.
class Buffers {
 public:
  Buffers(json list, std::optional<std::string_view> binary, const std::filesystem::path* folder,
          const std::string& file)
      : list_(std::move(list)), binary_(binary), folder_(folder), file_(file) {
    if (!list_.is_array() && !list_.is_null()) fail_reading(file_, "its \"buffers\" are no list");
    loaded_.resize(list_.size());
  }

  std::string_view bytes(std::size_t buffer) {
    if (buffer >= loaded_.size())
      fail_reading(file_,
                   "it names buffer " + std::to_string(buffer) + " of " + std::to_string(loaded_.size()));
    if (!loaded_[buffer].done) load(buffer);
    return loaded_[buffer].bytes;
  }

  /// Bytes of buffers that are not in the file itself.
  std::size_t outside() const { return outside_; }

 private:
  struct Loaded {
    bool done = false;
    std::string_view bytes;
    std::string decoded;
    std::unique_ptr<FileBytes> neighbour;
  };

  void load(std::size_t buffer) {
    const std::string name = "buffer " + std::to_string(buffer);
    const json& entry = list_[buffer];
    if (!entry.is_object() || !entry.contains("byteLength"))
      fail_reading(file_, "its " + name + " has no byteLength");
    if (!entry["byteLength"].is_number_unsigned())
      fail_reading(file_, "the byteLength of its " + name + " is no number");
    const auto length = entry["byteLength"].get<std::size_t>();
    Loaded& loaded = loaded_[buffer];
    if (!entry.contains("uri")) {
      if (buffer != 0 || !binary_)
        fail_reading(file_,
                     "its " + name + " has no data" +
                         (entry.contains("extensions")
                              ? ": it is compressed (meshopt), which is not supported; export it without "
                                "compression"
                              : ""));
      loaded.bytes = *binary_;
    } else {
      if (!entry["uri"].is_string()) fail_reading(file_, "the URI of its " + name + " is no text");
      const auto& uri = entry["uri"].get_ref<const std::string&>();
      if (uri.starts_with("data:")) {
        decode(uri, name, loaded);
      } else {
        const std::string neighbour = neighbour_name(uri, file_);
        if (folder_ == nullptr)
          fail_reading(file_, "its " + name + " is in the file " + shown(neighbour) +
                                  ", which cannot be found, as it was not read from a folder");
        const std::filesystem::path path = *folder_ / neighbour;
        loaded.neighbour = std::make_unique<FileBytes>(path, path.string());
        loaded.bytes = loaded.neighbour->view();
        outside_ += loaded.bytes.size();
      }
    }
    if (length > loaded.bytes.size())
      fail_reading(file_, "its " + name + " announces " + std::to_string(length) + " bytes, and there are " +
                              std::to_string(loaded.bytes.size()));
    loaded.bytes = loaded.bytes.substr(0, length);
    loaded.done = true;
  }

  void decode(const std::string& uri, const std::string& name, Loaded& loaded) const {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
      fail_reading(file_, "the data URI of its " + name + " is not in base64");
    const std::string_view text = std::string_view(uri).substr(comma + 1);
    std::optional<std::string> decoded = decode_base64(text);
    if (!decoded) fail_reading(file_, "the data URI of its " + name + " is damaged: it is no base64");
    loaded.decoded = std::move(*decoded);
    loaded.bytes = loaded.decoded;
  }

  json list_;
  std::optional<std::string_view> binary_;
  const std::filesystem::path* folder_;
  const std::string& file_;
  std::vector<Loaded> loaded_;
  std::size_t outside_ = 0;
};

std::size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

/// Elements in a buffer, known to be within it. Without data they are zeros.
struct Elements {
  const char* data = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
  std::size_t width = 1;  ///< components of an element
  int type = 0;
  bool normalized = false;

  template <class T>
  T load(std::size_t element, std::size_t component) const {
    T value{};
    if (data != nullptr) std::memcpy(&value, data + element * stride + component * sizeof(T), sizeof(T));
    return value;
  }

  std::uint32_t whole(std::size_t element) const {
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<std::uint8_t>(element, 0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(element, 0);
      default:
        return load<std::uint32_t>(element, 0);
    }
  }

  double number(std::size_t element, std::size_t component) const {
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return scaled(load<std::int8_t>(element, component), 127);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return scaled(load<std::uint8_t>(element, component), 255);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return scaled(load<std::int16_t>(element, component), 32767);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return scaled(load<std::uint16_t>(element, component), 65535);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return scaled(load<std::uint32_t>(element, component), 4294967295.0);
      default:
        return load<float>(element, component);
    }
  }

 private:
  double scaled(double value, double one) const { return normalized ? std::max(value / one, -1.0) : value; }
};

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const std::string& file, const Progress& progress,
             const std::filesystem::path* folder)
      : file_(file), progress_(progress), size_(bytes.size()) {
    const GltfContainer container = open_gltf(bytes, file, result_.warnings);
    json document = checked_gltf_json(container.json, file, progress);
    json buffers = document.contains("buffers") ? std::move(document["buffers"]) : json();
    document.erase("buffers");
    buffers_.emplace(std::move(buffers), container.binary, folder, file);
    load(document);
  }

  LoadedSoup read() {
    check_extensions();
    visit_nodes();
    if (result_.soup.polygon_count() == 0)
      fail_reading(
          file_, "it has no triangles" +
                     (left_out_ == 0 ? "" : ": " + counted_as(left_out_, "primitive") + " points or lines"));
    finish();
    return std::move(result_);
  }

 private:
  struct Placed {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    bool moves = false;  // otherwise positions stay as they are, bit by bit
  };

  void load(const json& document) {
    const std::string text = document.dump();
    if (text.size() > std::numeric_limits<unsigned>::max()) fail_reading(file_, "its JSON is too long");
    std::string error, warning;
    bool loaded = false;
    try {
      gltf::TinyGLTF loader;
      loaded = loader.LoadASCIIFromString(&model_, &error, &warning, text.data(),
                                          static_cast<unsigned>(text.size()), "");
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& exception) {  // of the JSON, or of a container
      error = exception.what();
    }
    // It goes on after some errors, without the parts that had them.
    if (!loaded || !error.empty()) fail_reading(file_, "its JSON is no glTF 2.0: " + one_line(error));
    if (!model_.asset.version.starts_with("2."))
      fail_reading(file_, "it is glTF of version " + shown(model_.asset.version) + ", not 2.0");
  }

  void check_extensions() const {
    for (const std::string& name : model_.extensionsRequired) {
      if (name == "KHR_draco_mesh_compression" || name.ends_with("_meshopt_compression"))
        fail_compressed(name);
      constexpr std::array<std::string_view, 13> kHarmless = {"KHR_mesh_quantization",
                                                              "EXT_mesh_manifold",
                                                              "KHR_materials_",
                                                              "EXT_materials_",
                                                              "KHR_texture_",
                                                              "EXT_texture_",
                                                              "MSFT_texture_",
                                                              "KHR_lights",
                                                              "EXT_lights_",
                                                              "KHR_animation",
                                                              "KHR_xmp",
                                                              "EXT_mesh_gpu_instancing",
                                                              "KHR_node_"};
      if (std::ranges::none_of(kHarmless, [&](std::string_view known) { return name.starts_with(known); }))
        fail_reading(file_, "it requires the extension " + shown(name) + ", which is not known");
    }
  }

  [[noreturn]] void fail_compressed(const std::string& how) const {
    fail_reading(file_, "its triangles are compressed (" + how +
                            "), which is not supported: export it without compression");
  }

  Elements elements(int accessor_index, const std::string& what) {
    const auto at = static_cast<std::size_t>(accessor_index);
    if (accessor_index < 0 || at >= model_.accessors.size())
      fail_reading(file_, what + " names accessor " + std::to_string(accessor_index) + " of " +
                              std::to_string(model_.accessors.size()));
    const gltf::Accessor& accessor = model_.accessors[at];
    const std::string name = "accessor " + std::to_string(at);
    Elements result;
    result.type = accessor.componentType;
    result.normalized = accessor.normalized;
    result.count = accessor.count;
    result.width = accessor.type == TINYGLTF_TYPE_SCALAR ? 1
                   : accessor.type == TINYGLTF_TYPE_VEC2 ? 2
                   : accessor.type == TINYGLTF_TYPE_VEC3 ? 3
                                                         : 4;
    const std::size_t component = component_size(accessor.componentType);
    if (component == 0)
      fail_reading(file_, "its " + name + " has components of the unknown type " +
                              std::to_string(accessor.componentType));
    if (accessor.bufferView < 0) {
      if (accessor.count > size_ + buffers_->outside())
        fail_reading(file_, "its " + name + " announces " + std::to_string(accessor.count) +
                                " elements without data, more than the file has bytes");
      result.stride = component * result.width;
      return result;
    }
    place(result, accessor.bufferView, accessor.byteOffset, component * result.width, name);
    return result;
  }

  /// Sets where elements are, and checks that they are within their buffer.
  void place(Elements& elements, int view_index, std::size_t offset, std::size_t size,
             const std::string& name) {
    const auto at = static_cast<std::size_t>(view_index);
    if (view_index < 0 || at >= model_.bufferViews.size())
      fail_reading(file_, "its " + name + " names buffer view " + std::to_string(view_index) + " of " +
                              std::to_string(model_.bufferViews.size()));
    const gltf::BufferView& view = model_.bufferViews[at];
    if (view.buffer < 0) fail_reading(file_, "its buffer view " + std::to_string(at) + " has no buffer");
    const std::string_view bytes = buffers_->bytes(static_cast<std::size_t>(view.buffer));
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
      fail_reading(file_, "its buffer view " + std::to_string(at) + " goes beyond the " +
                              std::to_string(bytes.size()) + " bytes of buffer " +
                              std::to_string(view.buffer));
    elements.stride = view.byteStride == 0 ? size : view.byteStride;
    if (elements.stride < size)
      fail_reading(file_, "the elements of its " + name + " overlap in buffer view " + std::to_string(at));
    const bool fits =
        elements.count == 0 || (offset <= view.byteLength && size <= view.byteLength - offset &&
                                elements.count - 1 <= (view.byteLength - offset - size) / elements.stride);
    if (!fits)
      fail_reading(file_, "its " + name + " goes beyond the " + std::to_string(view.byteLength) +
                              " bytes of buffer view " + std::to_string(at));
    elements.data = bytes.data() + view.byteOffset + (elements.count == 0 ? 0 : offset);
  }

  /// Calls set(element, source, number in the source) for each element and then for those that the accessor's
  /// sparse part replaces.
  template <class Set>
  void for_each_element(int accessor_index, const Elements& base, const Set& set) {
    for (std::size_t i = 0; i < base.count; ++i) {
      if ((i & 0xFFFFF) == 0xFFFFF) progress_.update("reading the mesh", 0.5);
      set(i, base, i);
    }
    const gltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(accessor_index)];
    if (!accessor.sparse.isSparse) return;
    const std::string name = "the sparse part of accessor " + std::to_string(accessor_index);
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > base.count)
      fail_reading(file_, name + " has " + std::to_string(sparse.count) + " elements of " +
                              std::to_string(base.count));
    Elements where, values = base;
    where.count = values.count = static_cast<std::size_t>(sparse.count);
    where.type = sparse.indices.componentType;
    if (!is_index_type(where.type)) fail_reading(file_, name + " has indices of an unknown type");
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
      fail_reading(file_, name + " has a negative offset");
    place(where, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
          component_size(where.type), name);
    place(values, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
          component_size(values.type) * values.width, name);
    for (std::size_t k = 0; k < where.count; ++k) {
      const std::size_t element = where.whole(k);
      if (element >= base.count)
        fail_reading(file_, name + " replaces element " + std::to_string(element) + " of " +
                                std::to_string(base.count));
      set(element, values, k);
    }
  }

  static bool is_index_type(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  }

  /// The nodes to begin with: of the default scene, or the first; without scenes, nodes that are no children.
  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      const int scene = std::max(model_.defaultScene, 0);
      if (static_cast<std::size_t>(scene) >= model_.scenes.size())
        fail_reading(file_, "its default scene is " + std::to_string(scene) + " of " +
                                std::to_string(model_.scenes.size()));
      return model_.scenes[static_cast<std::size_t>(scene)].nodes;
    }
    std::set<int> children;
    for (const gltf::Node& node : model_.nodes) children.insert(node.children.begin(), node.children.end());
    std::vector<int> result;
    for (int n = 0; static_cast<std::size_t>(n) < model_.nodes.size(); ++n)
      if (!children.contains(n)) result.push_back(n);
    return result;
  }

  static constexpr std::string_view kSurface = "surface";

  /// Whether it is a scene that morsel wrote (tools/export/glb_scene.h): a surface, and the points and arcs
  /// on it as parts of their own.
  bool is_own_scene() const {
    return model_.asset.generator.starts_with("morsel ") &&
           std::ranges::any_of(
               model_.nodes, [](const gltf::Node& node) { return node.mesh >= 0 && node.name == kSurface; });
  }

  void visit_nodes() {
    if (model_.scenes.empty() && model_.nodes.empty()) {
      for (std::size_t m = 0; m < model_.meshes.size(); ++m) add_mesh(m, {});
      return;
    }
    const bool is_own = is_own_scene();
    std::vector<bool> seen(model_.nodes.size(), false);
    std::vector<std::pair<int, Placed>> open;
    const auto push = [&](const std::vector<int>& nodes, const Placed& placed) {
      for (auto n = nodes.rbegin(); n != nodes.rend(); ++n) open.emplace_back(*n, placed);
    };
    push(roots(), {});
    while (!open.empty()) {
      const auto [n, parent] = std::move(open.back());
      open.pop_back();
      if (n < 0 || static_cast<std::size_t>(n) >= model_.nodes.size())
        fail_reading(file_,
                     "it names node " + std::to_string(n) + " of " + std::to_string(model_.nodes.size()));
      if (seen[static_cast<std::size_t>(n)])
        fail_reading(file_, "node " + std::to_string(n) + " is reached twice: nodes have one parent");
      seen[static_cast<std::size_t>(n)] = true;
      const gltf::Node& node = model_.nodes[static_cast<std::size_t>(n)];
      const Placed placed = placed_by(node, n, parent);
      const bool is_mark = is_own && node.mesh >= 0 && node.name != kSurface;
      has_marks_ = has_marks_ || is_mark;
      if (is_mark) {
        push(node.children, placed);
        continue;
      }
      instanced_ += node.mesh >= 0 && node.extensions.contains("EXT_mesh_gpu_instancing") ? 1 : 0;
      if (node.mesh >= 0) {
        const bool is_skinned = node.skin >= 0;
        skinned_ += is_skinned ? 1 : 0;
        if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
          fail_reading(file_, "node " + std::to_string(n) + " names mesh " + std::to_string(node.mesh) +
                                  " of " + std::to_string(model_.meshes.size()));
        const gltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
        const auto& weights = node.weights.empty() ? mesh.weights : node.weights;
        morphed_ += std::ranges::any_of(weights, [](double weight) { return weight != 0; }) ? 1 : 0;
        add_mesh(static_cast<std::size_t>(node.mesh), is_skinned ? Placed{} : placed);
      }
      push(node.children, placed);
    }
  }

  Placed placed_by(const gltf::Node& node, int number, const Placed& parent) const {
    const auto check = [&](const std::vector<double>& values, std::size_t size, const char* what) {
      if (!values.empty() && values.size() != size)
        fail_reading(file_, std::string("the ") + what + " of node " + std::to_string(number) + " has " +
                                std::to_string(values.size()) + " numbers, not " + std::to_string(size));
      return !values.empty();
    };
    Eigen::Matrix4d own = Eigen::Matrix4d::Identity();
    if (check(node.matrix, 16, "matrix")) {
      own = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());  // by columns, as glTF has it
      if (own.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
        fail_reading(file_, "the matrix of node " + std::to_string(number) + " does not end with 0 0 0 1");
    }
    if (check(node.translation, 3, "translation"))
      own.topRightCorner<3, 1>() = Eigen::Map<const Eigen::Vector3d>(node.translation.data());
    if (check(node.rotation, 4, "rotation")) {
      const auto& q = node.rotation;
      const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
      if (!(rotation.norm() > 0))
        fail_reading(file_, "the rotation of node " + std::to_string(number) + " is 0");
      own.topLeftCorner<3, 3>() = rotation.normalized().toRotationMatrix();
    }
    if (check(node.scale, 3, "scale"))
      own.topLeftCorner<3, 3>() =
          own.topLeftCorner<3, 3>() * Eigen::Map<const Eigen::Vector3d>(node.scale.data()).asDiagonal();
    if (own == Eigen::Matrix4d::Identity()) return parent;
    return {parent.moves ? Eigen::Matrix4d(parent.matrix * own) : own, true};
  }

  void add_mesh(std::size_t mesh, const Placed& placed) {
    shared_.clear();
    const auto& primitives = model_.meshes[mesh].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      progress_.update("reading the mesh", 0.5);
      add_primitive(primitives[p], placed,
                    "primitive " + std::to_string(p) + " of mesh " + std::to_string(mesh));
    }
  }

  void add_primitive(const gltf::Primitive& primitive, const Placed& placed, const std::string& name) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
      fail_reading(file_, name + " has the unknown mode " + std::to_string(primitive.mode));
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
      ++left_out_;
      return;
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
      ++without_positions_;
      return;
    }
    if (primitive.extensions.contains("KHR_draco_mesh_compression") && !has_data(position->second))
      fail_compressed("KHR_draco_mesh_compression");
    const auto [first, count] = vertices(primitive, position->second, placed, name);
    const bool mirrors = placed.moves && placed.matrix.topLeftCorner<3, 3>().determinant() < 0;
    add_triangles(primitive, first, count, mirrors, name);
  }

  bool has_data(int accessor) const {
    return accessor >= 0 && static_cast<std::size_t>(accessor) < model_.accessors.size() &&
           model_.accessors[static_cast<std::size_t>(accessor)].bufferView >= 0;
  }

  /// Throws before more than the limit of vertices, corners and values is stored.
  void make_room(std::size_t more) {
    const std::size_t limit = kRepeated + kPerByte * (size_ + buffers_->outside());
    used_ += more;
    if (used_ > limit || result_.soup.positions.size() + more >= kNone)
      fail_reading(file_,
                   "it repeats its meshes so often, or has so many attributes for parts of them, that "
                   "there are more than " +
                       std::to_string(limit) + " vertices, corners and values");
  }

  /// The first vertex of the primitive and their number.
  std::pair<Index, std::size_t> vertices(const gltf::Primitive& primitive, int position, const Placed& placed,
                                         const std::string& name) {
    std::map<std::string, int> key = {{"POSITION", position}};
    for (const auto& [attribute, accessor] : primitive.attributes)
      if (attribute.starts_with('_')) key.emplace(attribute, accessor);
    const Elements elements = this->elements(position, name);
    if (const auto known = shared_.find(key); known != shared_.end()) return {known->second, elements.count};
    const bool is_quantized = elements.type != TINYGLTF_COMPONENT_TYPE_FLOAT;
    if (elements.width != 3 ||
        model_.accessors[static_cast<std::size_t>(position)].type != TINYGLTF_TYPE_VEC3 ||
        (is_quantized && elements.type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
      fail_reading(file_,
                   "the positions of " + name + " are no vectors of three numbers that glTF has for them");
    make_room(elements.count);
    auto& positions = result_.soup.positions;
    const std::size_t first = positions.size();
    positions.resize(first + elements.count);
    for_each_element(position, elements, [&](std::size_t i, const Elements& source, std::size_t k) {
      const Point p(source.number(k, 0), source.number(k, 1), source.number(k, 2));
      positions[first + i] = placed.moves ? Point((placed.matrix * p.homogeneous()).head<3>()) : p;
    });
    for (const auto& [attribute, accessor] : key)
      if (attribute != "POSITION") add_property(attribute, accessor, first, elements.count, name);
    shared_.emplace(std::move(key), static_cast<Index>(first));
    return {static_cast<Index>(first), elements.count};
  }

  void add_property(const std::string& attribute, int accessor, std::size_t first, std::size_t count,
                    const std::string& name) {
    const Elements elements = this->elements(accessor, name);
    if (model_.accessors[static_cast<std::size_t>(accessor)].type != TINYGLTF_TYPE_SCALAR) return;
    if (elements.count != count)
      fail_reading(file_, name + " has " + std::to_string(count) + " positions and " +
                              std::to_string(elements.count) + " values of " + shown(attribute));
    auto found = std::ranges::find(result_.properties, attribute, &VertexProperty::name);
    if (found == result_.properties.end()) found = result_.properties.insert(found, {attribute, {}});
    pad(*found, first + count);
    for_each_element(accessor, elements, [&](std::size_t i, const Elements& source, std::size_t k) {
      found->values[first + i] = source.number(k, 0);
    });
  }

  /// Vertices without a value have NaN.
  void pad(VertexProperty& property, std::size_t count) {
    if (property.values.size() >= count) return;
    make_room(count - property.values.size());
    property.values.resize(count, std::numeric_limits<double>::quiet_NaN());
  }

  void add_triangles(const gltf::Primitive& primitive, Index first, std::size_t count, bool mirrors,
                     const std::string& name) {
    Elements indices;
    std::vector<Index> corners;
    if (primitive.indices >= 0) {
      indices = elements(primitive.indices, name);
      if (!is_index_type(indices.type) ||
          model_.accessors[static_cast<std::size_t>(primitive.indices)].type != TINYGLTF_TYPE_SCALAR)
        fail_reading(file_, "the indices of " + name + " are no whole numbers");
      make_room(indices.count);
      corners.resize(indices.count);
      for_each_element(primitive.indices, indices, [&](std::size_t i, const Elements& source, std::size_t k) {
        corners[i] = source.whole(k);
      });
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if ((i & 0xFFFF) == 0) progress_.throw_if_cancelled();
        if (corners[i] >= count)
          fail_reading(file_,
                       name + " names vertex " + std::to_string(corners[i]) + " of " + std::to_string(count));
      }
    } else {
      make_room(count);
      corners.resize(count);
      for (std::size_t i = 0; i < count; ++i) corners[i] = static_cast<Index>(i);
    }
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (is_list && corners.size() % 3 != 0)
      fail_reading(
          file_, name + " has " + std::to_string(corners.size()) + " corners, which is no multiple of three");
    make_room(is_list ? corners.size() : 3 * corners.size());
    PolygonSoup& soup = result_.soup;
    const auto add = [&](Index a, Index b, Index c) {
      if (mirrors) std::swap(b, c);
      for (const Index v : {a, b, c}) soup.corners.push_back(first + v);
      soup.offsets.push_back(soup.corners.size());
    };
    if (is_list) {
      for (std::size_t i = 0; i < corners.size(); i += 3) {
        if (i % (3 << 16) == 0) progress_.throw_if_cancelled();
        add(corners[i], corners[i + 1], corners[i + 2]);
      }
      return;
    }
    const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
      if ((i & 0xFFFF) == 0) progress_.throw_if_cancelled();
      const Index a = is_strip ? corners[i] : corners[0];
      const Index b = is_strip ? corners[i + (1 + i % 2)] : corners[i + 1];
      const Index c = is_strip ? corners[i + (2 - i % 2)] : corners[i + 2];
      if (!is_strip || (a != b && b != c && c != a)) add(a, b, c);  // repeated ones begin another strip
    }
  }

  void finish() {
    auto& warnings = result_.warnings;
    const std::size_t count = result_.soup.positions.size();
    for (VertexProperty& property : result_.properties) {
      pad(property, count);
      if (!std::ranges::any_of(property.values, [](double value) { return std::isnan(value); })) continue;
      warnings.push_back("not all of its vertices have a value of " + shown(property.name));
    }
    if (has_marks_) warnings.emplace_back("the points and arcs of the scene are left out");
    if (left_out_ > 0)
      warnings.push_back(counted_as(left_out_, "primitive") + " points or lines, and left out");
    if (without_positions_ > 0)
      warnings.push_back(counted_as(without_positions_, "primitive") + " without positions, and left out");
    if (instanced_ > 0)
      warnings.push_back(counted_as(instanced_, "node") +
                         " instanced (EXT_mesh_gpu_instancing), of which one instance is read");
    if (skinned_ > 0)
      warnings.push_back(counted_as(skinned_, "node") +
                         " skinned: the mesh is read as it is without its skeleton, at the origin");
    if (morphed_ > 0)
      warnings.push_back(counted_as(morphed_, "node") +
                         " morphed: the mesh is read without its morph targets");
  }

  const std::string& file_;
  const Progress& progress_;
  std::size_t size_;
  std::optional<Buffers> buffers_;
  gltf::Model model_;
  std::map<std::map<std::string, int>, Index> shared_;  // of a node: accessors to their first vertex
  std::size_t used_ = 0;
  bool has_marks_ = false;  // of an own scene, which are left out
  std::size_t left_out_ = 0, without_positions_ = 0, instanced_ = 0, skinned_ = 0, morphed_ = 0;
  LoadedSoup result_;
};

}  // namespace

LoadedSoup read_gltf(std::string_view bytes, const std::string& file, const Progress& progress) {
  return GltfReader(bytes, file, progress, nullptr).read();
}

LoadedSoup read_gltf(std::string_view bytes, const std::string& file, const Progress& progress,
                     const std::filesystem::path& folder) {
  return GltfReader(bytes, file, progress, &folder).read();
}

}  // namespace morsel::core
