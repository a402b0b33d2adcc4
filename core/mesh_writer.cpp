#include "morsel/core/mesh_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/file_writer.h"

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

void check_property(const VertexProperty& property, std::size_t vertices,
                    std::span<const VertexProperty> earlier) {
  const std::string& name = property.name;
  const bool is_word = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) > ' ' && c != '\x7F';
  });
  const bool is_taken =
      name == "x" || name == "y" || name == "z" ||
      std::any_of(earlier.begin(), earlier.end(), [&](const VertexProperty& p) { return p.name == name; });
  if (!is_word || is_taken)
    throw InvalidArgument("a PLY file cannot hold a property named \"" + name + "\"" +
                          (is_taken ? ": the name is taken" : ": names are single words"));
  if (property.values.size() != vertices)
    throw InvalidArgument("property " + name + " needs " + std::to_string(vertices) + " values, not " +
                          std::to_string(property.values.size()));
}

}  // namespace

void write_off(const std::filesystem::path& path, const TriangleMesh& mesh, const Progress& progress) {
  FileWriter writer(path);
  writer.write("OFF\n");
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

void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh,
               std::span<const VertexProperty> properties, const Progress& progress) {
  write_ply(path, mesh.positions(), mesh.triangles(), properties, progress);
}

void write_ply(const std::filesystem::path& path, std::span<const Point> positions,
               std::span<const Triangle> triangles, std::span<const VertexProperty> properties,
               const Progress& progress) {
  for (std::size_t i = 0; i < properties.size(); ++i)
    check_property(properties[i], positions.size(), properties.first(i));
  FileWriter writer(path);
  writer.write("ply\nformat binary_little_endian 1.0\nelement vertex ");
  writer.write_number(std::uint64_t{positions.size()});
  writer.write("\nproperty double x\nproperty double y\nproperty double z\n");
  for (const VertexProperty& p : properties) writer.write("property double " + p.name + "\n");
  writer.write("element face ");
  writer.write_number(std::uint64_t{triangles.size()});
  writer.write("\nproperty list uchar uint vertex_indices\nend_header\n");
  LittleEndian values(writer);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if ((v & kProgressStep) == kProgressStep)
      progress.update("writing the mesh",
                      0.5 * static_cast<double>(v) / static_cast<double>(positions.size()));
    for (int axis = 0; axis < 3; ++axis) values.write(positions[v][axis]);
    for (const VertexProperty& p : properties) values.write(p.values[v]);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if ((t & kProgressStep) == kProgressStep)
      progress.update("writing the mesh",
                      0.5 + 0.5 * static_cast<double>(t) / static_cast<double>(triangles.size()));
    values.write(std::uint8_t{3});
    for (const Index v : triangles[t]) values.write(std::uint32_t{v});
  }
  writer.commit();
}

void write_obj(const std::filesystem::path& path, std::span<const Point> positions,
               std::span<const std::array<Index, 4>> quads, const Progress& progress) {
  FileWriter writer(path);
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
