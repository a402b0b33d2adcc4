#include "morsel/tools/report/hashed_mesh.h"

#include <exception>
#include <optional>
#include <type_traits>
#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/formats/sha256.h"

namespace morsel::tools {
namespace {

/// Returns the result of `read`, and the hash.
template <class Hashed, class Read>
Hashed read_hashed(const std::filesystem::path& path, const Read& read) {
  std::optional<std::invoke_result_t<Read>> loaded;
  std::string hash;
  std::exception_ptr hash_error;  // if a file cannot be read, the reader's error is more specific
  core::parallel_for(0, 2, 1, [&](std::size_t task, std::size_t) {
    if (task == 0) {
      loaded.emplace(read());
      return;
    }
    try {
      hash = sha256_of_file(path);
    } catch (...) {
      hash_error = std::current_exception();
    }
  });
  if (hash_error) std::rethrow_exception(hash_error);
  return {std::move(*loaded), std::move(hash)};
}

}  // namespace

HashedMesh read_hashed_mesh(const std::filesystem::path& path, const core::BuildOptions& options,
                            const core::Progress& progress) {
  return read_hashed<HashedMesh>(path, [&] { return core::read_mesh(path, options, progress); });
}

HashedWholeMesh read_hashed_whole_mesh(const std::filesystem::path& path, const core::BuildOptions& options,
                                       const core::Progress& progress) {
  return read_hashed<HashedWholeMesh>(path, [&] { return core::read_whole_mesh(path, options, progress); });
}

}  // namespace morsel::tools
