// FreeSurfer's surfaces (Fischl 2012; the formats as nibabel reads them).

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "morsel/core/io/big_endian.h"
#include "morsel/core/io/freesurfer.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace freesurfer {
namespace {

constexpr std::size_t kMagic = 3;
constexpr std::size_t kMorphometryHeader = kMagic + 12;

bool begins_with(std::string_view bytes, FreeSurferMagic magic) {
  return bytes.size() >= kMagic && BigEndianReader(bytes).unsigned24() == static_cast<std::uint32_t>(magic);
}

/// The sizes of a file's parts, of which the counts are still to be compared with its length.
struct Layout {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t vertex_size = 0;
  std::uint64_t face_size = 0;

  std::uint64_t size() const { return vertices * vertex_size + faces * face_size; }
};

/// Throws unless the parts are in the rest of the file.
void check_room(const Layout& layout, std::string_view kind, std::size_t room, const std::string& file) {
  if (layout.size() > room)
    fail_reading(file, "it announces " + std::to_string(layout.vertices) + " vertices and " +
                           std::to_string(layout.faces) + " " + std::string(kind) + ", which take " +
                           std::to_string(layout.size()) + " bytes, but only " + std::to_string(room) +
                           " are left for them");
}

class SurfaceReader {
 public:
  SurfaceReader(std::string_view bytes, const std::string& file, const Progress& progress)
      : reader_(bytes), file_(file), progress_(progress) {}

  LoadedSoup read() {
    if (reader_.remaining() < kMagic) fail_reading(file_, "it is too short for a FreeSurfer surface");
    const std::uint32_t magic = reader_.unsigned24();
    if (magic == static_cast<std::uint32_t>(FreeSurferMagic::triangles)) {
      read_triangles();
    } else if (magic == static_cast<std::uint32_t>(FreeSurferMagic::quads)) {
      read_quads(6, [&] { return static_cast<double>(reader_.signed16()) / 100; });
    } else if (magic == static_cast<std::uint32_t>(FreeSurferMagic::quads_of_floats)) {
      read_quads(12, [&] { return static_cast<double>(reader_.float32()); });
    } else {
      fail_reading(file_, "it does not begin as a FreeSurfer surface does (with the bytes ff ff fe)");
    }
    return std::move(result_);
  }

 private:
  void read_triangles() {
    // Who made it and when, on a line, and an empty line.
    std::size_t length = 0;
    while (true) {
      if (reader_.remaining() == 0)
        fail_reading(file_, "it ends within its first line, which says who made it");
      const char c = reader_.bytes(1).front();
      if ((++length & 0xFFFF) == 0) progress_.throw_if_cancelled();
      if (c == '\n') break;
    }
    if (reader_.peek() == '\n') reader_.bytes(1);
    if (reader_.remaining() < 8) fail_reading(file_, "it ends before the numbers of vertices and triangles");
    const std::int32_t vertices = reader_.signed32();
    const std::int32_t faces = reader_.signed32();
    if (vertices < 0 || faces < 0)
      fail_reading(file_, "it announces " + std::to_string(vertices) + " vertices and " +
                              std::to_string(faces) + " triangles");
    const Layout layout{static_cast<std::uint64_t>(vertices), static_cast<std::uint64_t>(faces), 12, 12};
    check_room(layout, "triangles", reader_.remaining(), file_);
    read_positions(layout, [&] { return static_cast<double>(reader_.float32()); });
    read_faces<3>(layout, "triangle", [&] { return reader_.unsigned32(); });
    // What follows, such as the geometry of the volume that the surface was made of, is of no use here.
  }

  template <class Coordinate>
  void read_quads(std::uint64_t vertex_size, const Coordinate& coordinate) {
    if (reader_.remaining() < 6) fail_reading(file_, "it ends before the numbers of vertices and quads");
    const std::uint64_t vertices = reader_.unsigned24();
    const std::uint64_t faces = reader_.unsigned24();
    const Layout layout{vertices, faces, vertex_size, 12};
    check_room(layout, "quads", reader_.remaining(), file_);
    read_positions(layout, coordinate);
    read_faces<4>(layout, "quad", [&] { return reader_.unsigned24(); });
  }

  template <class Coordinate>
  void read_positions(const Layout& layout, const Coordinate& coordinate) {
    auto& positions = result_.soup.positions;
    positions.resize(layout.vertices);
    for (std::uint64_t v = 0; v < layout.vertices; ++v) {
      for (int axis = 0; axis < 3; ++axis) positions[v][axis] = coordinate();
      if ((v & 0xFFFF) == 0xFFFF)
        progress_.update("reading the mesh", static_cast<double>(v) / (layout.vertices + layout.faces));
    }
  }

  template <std::size_t kCorners, class Corner>
  void read_faces(const Layout& layout, std::string_view kind, const Corner& corner) {
    PolygonSoup& soup = result_.soup;
    soup.corners.reserve(kCorners * layout.faces);
    soup.offsets.reserve(layout.faces + 1);
    for (std::uint64_t f = 0; f < layout.faces; ++f) {
      for (std::size_t i = 0; i < kCorners; ++i) {
        const std::uint32_t v = corner();
        if (v >= layout.vertices)
          fail_reading(file_, std::string(kind) + " " + std::to_string(f) + " names vertex " +
                                  std::to_string(static_cast<std::int32_t>(v)) + ", but there are " +
                                  std::to_string(layout.vertices));
        soup.corners.push_back(v);
      }
      soup.offsets.push_back(soup.corners.size());
      if ((f & 0xFFFF) == 0xFFFF)
        progress_.update("reading the mesh",
                         static_cast<double>(layout.vertices + f) / (layout.vertices + layout.faces));
    }
  }

  BigEndianReader reader_;
  const std::string& file_;
  const Progress& progress_;
  LoadedSoup result_;
};

}  // namespace
}  // namespace freesurfer

bool is_freesurfer_morphometry(std::string_view bytes) {
  using namespace freesurfer;
  BigEndianReader reader(bytes);
  if (begins_with(bytes, FreeSurferMagic::quads)) {
    // An old surface of quads has the same magic, and bytes that are no such counts, or another length.
    if (bytes.size() < kMorphometryHeader) return false;
    reader.unsigned24();
    const std::int32_t vertices = reader.signed32();
    reader.signed32();
    const std::int32_t values = reader.signed32();
    return vertices >= 0 && values >= 1 &&
           bytes.size() == kMorphometryHeader + 4 * static_cast<std::uint64_t>(vertices) * values;
  }
  // The old kind has no magic, but numbers of vertices and faces whose first byte begins no text.
  constexpr char kFirstOfText = '\t';
  if (bytes.size() < 6 || bytes[0] < 0 || bytes[0] >= kFirstOfText) return false;
  return bytes.size() == 6 + 2 * static_cast<std::uint64_t>(reader.unsigned24());
}

bool is_freesurfer_surface(std::string_view bytes) {
  using namespace freesurfer;
  return begins_with(bytes, FreeSurferMagic::triangles) ||
         ((begins_with(bytes, FreeSurferMagic::quads) ||
           begins_with(bytes, FreeSurferMagic::quads_of_floats)) &&
          !is_freesurfer_morphometry(bytes));
}

bool is_named_like_freesurfer_surface(const std::filesystem::path& path) {
  constexpr auto kSurfaces = std::to_array<std::string_view>({"white", "pial", "orig", "smoothwm", "inflated",
                                                              "sphere", "qsphere", "midthickness", "graymid",
                                                              "pial-outer-smoothed", "pial_semi_inflated"});
  constexpr auto kSuffixes = std::to_array<std::string_view>(
      {"reg", "nofix", "premesh", "preaparc", "deformed", "left_right", "T1", "T2", "FLAIR"});
  const std::string name = path.filename().string();
  std::string_view rest = name;
  if (!rest.starts_with("lh.") && !rest.starts_with("rh.")) return false;
  rest.remove_prefix(3);
  const auto has = [](const auto& names, std::string_view word) {
    return std::ranges::find(names, word) != names.end();
  };
  while (true) {
    const std::size_t dot = rest.rfind('.');
    const std::string_view last = dot == std::string_view::npos ? rest : rest.substr(dot + 1);
    if (has(kSurfaces, last)) return true;
    if (dot == std::string_view::npos || !has(kSuffixes, last)) return false;
    rest = rest.substr(0, dot);
  }
}

LoadedSoup read_freesurfer(std::string_view bytes, const std::string& file, const Progress& progress) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  if (is_freesurfer_morphometry(bytes))
    fail_reading(file,
                 "it is no surface: it has values for the vertices of one (vertex-scalar:file= reads them)");
  return freesurfer::SurfaceReader(bytes, file, progress).read();
}

}  // namespace morsel::core
