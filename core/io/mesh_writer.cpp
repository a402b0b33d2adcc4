#include "morsel/core/io/mesh_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"

namespace morsel::core {
namespace {

constexpr std::size_t kProgressStep = 0xFFFF;

/// Values in little-endian order, whatever the machine's is.
class LittleEndian {
 public:
  explicit LittleEndian(FileWriter& writer) : writer_(writer) {}
  template <class T>
  void write(T value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    writer_.write_bytes(bytes.data(), bytes.size());
  }

 private:
  FileWriter& writer_;
};

void write_comments(FileWriter& writer, std::string_view mark, Comments comments) {
  for (const std::string& line : comments) {
    if (line.ends_with('\\') || std::any_of(line.begin(), line.end(), [](char c) {
          return static_cast<unsigned char>(c) < ' ' || c == '\x7F';
        }))
      throw InvalidArgument(
          "a comment of a mesh file is one line, without control characters and a backslash at its end");
    writer.write(mark);
    writer.write(line);
    writer.write("\n");
  }
}

std::size_t size_of(const PropertyView& property) {
  return std::visit([](const auto& values) { return values.size(); }, property.values);
}

void check_properties(std::span<const PropertyView> properties, std::size_t elements,
                      std::vector<std::string_view> taken) {
  for (const PropertyView& property : properties) {
    const std::string& name = property.name;
    const bool is_word = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
      return static_cast<unsigned char>(c) > ' ' && c != '\x7F';
    });
    const bool is_taken = std::find(taken.begin(), taken.end(), name) != taken.end();
    if (!is_word || is_taken)
      throw InvalidArgument("a PLY file cannot hold a property named \"" + name + "\"" +
                            (is_taken ? ": the name is taken" : ": names are single words"));
    if (size_of(property) != elements)
      throw InvalidArgument("property " + name + " needs " + std::to_string(elements) + " values, not " +
                            std::to_string(size_of(property)));
    taken.push_back(name);
  }
}

void declare(FileWriter& writer, std::span<const PropertyView> properties) {
  constexpr std::array kTypes = {"double", "int", "uchar"};  // in the order of the variant
  for (const PropertyView& property : properties)
    writer.write(std::string("property ") + kTypes[property.values.index()] + " " + property.name + "\n");
}

}  // namespace

void write_off(const FileTarget& target, const TriangleMesh& mesh, Comments comments,
               const Progress& progress) {
  FileWriter writer(target);
  writer.write("OFF\n");
  write_comments(writer, "# ", comments);
  writer.write_number(std::uint64_t{mesh.vertex_count()});
  writer.write(" ");
  writer.write_number(std::uint64_t{mesh.triangle_count()});
  writer.write(" 0\n");
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if ((v & kProgressStep) == kProgressStep)
      progress.update("writing the mesh", 0.3 * v / mesh.vertex_count());
    for (int axis = 0; axis < 3; ++axis) {
      writer.write_number(mesh.position(v)[axis]);
      writer.write(axis < 2 ? " " : "\n");
    }
  }
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if ((t & kProgressStep) == kProgressStep)
      progress.update("writing the mesh", 0.3 + 0.7 * t / mesh.triangle_count());
    writer.write("3");
    for (const Index v : mesh.triangle(t)) {
      writer.write(" ");
      writer.write_number(std::uint64_t{v});
    }
    writer.write("\n");
  }
  writer.commit();
}

void write_ply(const FileTarget& target, const TriangleMesh& mesh, std::span<const VertexProperty> properties,
               Comments comments, const Progress& progress) {
  std::vector<PropertyView> views;
  for (const VertexProperty& property : properties) views.emplace_back(property.name, property.values);
  write_ply(target, mesh.positions(), mesh.triangles(), views, {}, comments, progress);
}

void write_ply(const FileTarget& target, std::span<const Point> positions,
               std::span<const Triangle> triangles, std::span<const PropertyView> vertex_properties,
               std::span<const PropertyView> face_properties, Comments comments, const Progress& progress) {
  check_properties(vertex_properties, positions.size(), {"x", "y", "z"});
  check_properties(face_properties, triangles.size(), {"vertex_indices", "vertex_index"});
  FileWriter writer(target);
  writer.write("ply\nformat binary_little_endian 1.0\n");
  write_comments(writer, "comment ", comments);
  writer.write("element vertex ");
  writer.write_number(std::uint64_t{positions.size()});
  writer.write("\nproperty double x\nproperty double y\nproperty double z\n");
  declare(writer, vertex_properties);
  writer.write("element face ");
  writer.write_number(std::uint64_t{triangles.size()});
  writer.write("\nproperty list uchar uint vertex_indices\n");
  declare(writer, face_properties);
  writer.write("end_header\n");
  LittleEndian values(writer);
  const auto write_properties = [&](std::span<const PropertyView> properties, std::size_t i) {
    for (const PropertyView& property : properties)
      std::visit([&](const auto& numbers) { values.write(numbers[i]); }, property.values);
  };
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if ((v & kProgressStep) == kProgressStep)
      progress.update("writing the mesh",
                      0.5 * static_cast<double>(v) / static_cast<double>(positions.size()));
    for (int axis = 0; axis < 3; ++axis) values.write(positions[v][axis]);
    write_properties(vertex_properties, v);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if ((t & kProgressStep) == kProgressStep)
      progress.update("writing the mesh",
                      0.5 + 0.5 * static_cast<double>(t) / static_cast<double>(triangles.size()));
    values.write(std::uint8_t{3});
    for (const Index v : triangles[t]) values.write(std::uint32_t{v});
    write_properties(face_properties, t);
  }
  writer.commit();
}

void write_obj(const FileTarget& target, std::span<const Point> positions,
               std::span<const std::array<Index, 4>> quads, Comments comments, const Progress& progress) {
  FileWriter writer(target);
  write_comments(writer, "# ", comments);
  const double all = static_cast<double>(positions.size() + quads.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if ((v & kProgressStep) == kProgressStep)
      progress.update("writing the mesh", static_cast<double>(v) / all);
    writer.write("v");
    for (int axis = 0; axis < 3; ++axis) {
      writer.write(" ");
      writer.write_number(positions[v][axis]);
    }
    writer.write("\n");
  }
  for (std::size_t q = 0; q < quads.size(); ++q) {
    if ((q & kProgressStep) == kProgressStep)
      progress.update("writing the mesh", static_cast<double>(positions.size() + q) / all);
    writer.write("f");
    for (const Index v : quads[q]) {
      writer.write(" ");
      writer.write_number(std::uint64_t{v} + 1);
    }
    writer.write("\n");
  }
  writer.commit();
}

}  // namespace morsel::core
