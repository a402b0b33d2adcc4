#include "morsel/tools/report/hashed_mesh.h"

#include <exception>
#include <optional>
#include <utility>

#include "morsel/core/parallel.h"
#include "morsel/tools/report/sha256.h"

namespace morsel::tools {

HashedMesh read_hashed_mesh(const std::filesystem::path& path, const core::BuildOptions& options,
                            const core::Progress& progress) {
  std::optional<core::LoadedMesh> loaded;
  std::string hash;
  std::exception_ptr hash_error;  // of a file that cannot be read the reader has more to tell
  core::parallel_for(0, 2, 1, [&](std::size_t task, std::size_t) {
    if (task == 0) {
      loaded.emplace(core::read_mesh(path, options, progress));
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

}  // namespace morsel::tools
