#include "morsel/tools/report/hashed_mesh.h"

#include <exception>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/formats/sha256.h"

namespace morsel::tools {
namespace {

/// Returns the result of `read`, and the hash.
template <class Hashed, class Read>
Hashed read_hashed(const MeshOrigin& file, const core::BuildOptions& options, const Read& read) {
  std::optional<std::invoke_result_t<Read>> loaded;
  std::string hash;
  std::exception_ptr hash_error;  // if a file cannot be read, the reader's error is more specific
  core::parallel_for(0, 2, 1, [&](std::size_t task, std::size_t) {
    if (task == 0) {
      loaded.emplace(read());
      return;
    }
    try {
      hash = sha256_of(file, options);
    } catch (...) {
      hash_error = std::current_exception();
    }
  });
  if (hash_error) std::rethrow_exception(hash_error);
  return {std::move(*loaded), std::move(hash)};
}

}  // namespace

core::LoadedSoup read_polygon_soup(const MeshOrigin& file, const core::Progress& progress) {
  if (file.bytes && !file.format)
    throw core::InvalidArgument(file.path.string() +
                                " has no name that says its format, which must be given");
  if (file.bytes) return core::parse_polygon_soup(*file.bytes, *file.format, file.path.string(), progress);
  if (file.format) return core::read_polygon_soup(file.path, *file.format, progress);
  return core::read_polygon_soup(file.path, progress);
}

std::string sha256_of(const MeshOrigin& file, const core::BuildOptions& options) {
  const std::string hash = file.bytes ? sha256_of(*file.bytes) : sha256_of_file(file.path);
  std::vector<std::filesystem::path> others;
  if (!file.bytes) others = core::companion_files(file.path, file.format);
  if (options.mask && !options.mask->file.empty()) others.push_back(options.mask->file);
  std::string of_others;
  for (const std::filesystem::path& other : others) {
    std::error_code error;  // what the mesh does not need may be missing; for what it needs, reading it fails
    if (std::filesystem::is_regular_file(other, error)) of_others += sha256_of_file(other) + "\n";
  }
  return of_others.empty() ? hash : sha256_of(hash + "\n" + of_others);
}

HashedMesh read_hashed_mesh(const MeshOrigin& file, const core::BuildOptions& options,
                            const core::Progress& progress) {
  return read_hashed<HashedMesh>(file, options, [&] {
    return core::make_mesh(read_polygon_soup(file, progress), file.path.string(), options, progress);
  });
}

HashedMesh read_hashed_mesh(const std::filesystem::path& path, const core::BuildOptions& options,
                            const core::Progress& progress) {
  return read_hashed_mesh(MeshOrigin{path}, options, progress);
}

HashedWholeMesh read_hashed_whole_mesh(const std::filesystem::path& path, const core::BuildOptions& options,
                                       const core::Progress& progress) {
  return read_hashed_whole_mesh(MeshOrigin{path}, options, progress);
}

HashedWholeMesh read_hashed_whole_mesh(const MeshOrigin& file, const core::BuildOptions& options,
                                       const core::Progress& progress) {
  return read_hashed<HashedWholeMesh>(file, options, [&] {
    return core::make_whole_mesh(read_polygon_soup(file, progress), file.path.string(), options, progress);
  });
}

}  // namespace morsel::tools
