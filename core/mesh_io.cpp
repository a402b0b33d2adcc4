#include "morsel/core/mesh_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include "morsel/core/mesh_formats.h"
#include "morsel/core/text_scanner.h"

namespace morsel::core {
namespace {

/// All bytes of a file. Read, not mapped: a mapped file that is cut while it is parsed kills the program.
class FileBytes {
 public:
  FileBytes(const std::filesystem::path& path, const std::string& name) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) fail_reading(name, std::generic_category().message(errno));
    const struct Closer {
      int file;
      ~Closer() { ::close(file); }
    } closer{file};
    struct stat status {};
    if (::fstat(file, &status) != 0) fail_reading(name, std::generic_category().message(errno));
    if (S_ISDIR(status.st_mode)) fail_reading(name, "it is a directory");
    if (!S_ISREG(status.st_mode)) fail_reading(name, "it is not a regular file");
    const auto size = static_cast<std::size_t>(status.st_size);
    bytes_ = std::make_unique_for_overwrite<char[]>(size);
    while (size_ < size) {
      const ssize_t got = ::read(file, bytes_.get() + size_, std::min<std::size_t>(size - size_, 1 << 28));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail_reading(name, std::generic_category().message(errno));
      if (got == 0) break;
      size_ += static_cast<std::size_t>(got);
    }
  }
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace

MeshFormat mesh_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (extension == ".off") return MeshFormat::off;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  fail_reading(path.string(), extension.empty()
                                  ? "its name has no extension: use .off, .obj, .ply or .stl"
                                  : "meshes are read from .off, .obj, .ply and .stl files, not " + extension);
}

LoadedSoup parse_polygon_soup(std::string_view bytes, MeshFormat format, const std::string& name,
                              const Progress& progress) {
  progress.update("reading the mesh", 0);
  switch (format) {
    case MeshFormat::off:
      return read_off(bytes, name, progress);
    case MeshFormat::obj:
      return read_obj(bytes, name, progress);
    case MeshFormat::ply:
      return read_ply(bytes, name, progress);
    case MeshFormat::stl:
      return read_stl(bytes, name, progress);
  }
  throw InvalidArgument("unknown mesh format " + std::to_string(static_cast<int>(format)));
}

LoadedSoup read_polygon_soup(const std::filesystem::path& path, const Progress& progress) {
  const std::string name = path.string();
  // A missing file is reported as such, whatever its extension.
  const FileBytes bytes(path, name);
  return parse_polygon_soup(bytes.view(), mesh_format(path), name, progress);
}

LoadedMesh read_mesh(const std::filesystem::path& path, const BuildOptions& options,
                     const Progress& progress) {
  LoadedSoup loaded = read_polygon_soup(path, progress);
  try {
    BuiltMesh built = build_mesh(std::move(loaded.soup), options, progress);
    return {std::move(built.mesh),
            {std::move(built.numbering), std::move(loaded.properties), std::move(built.repairs)}};
  } catch (const MeshError& error) {
    throw error.about("\"" + path.string() + "\"");
  } catch (const BadInput& error) {
    throw BadInput("cannot use \"" + path.string() + "\": " + error.what());
  }
}

}  // namespace morsel::core
