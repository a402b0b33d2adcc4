// In place of the reading of files by libraries, in a library without the part FORMATS.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/brain_values.h"
#include "morsel/core/io/decompression.h"
#include "morsel/core/io/file_formats.h"
#include "morsel/core/io/gltf.h"
#include "morsel/core/io/mesh_formats.h"

namespace morsel::core {

void require_formats(std::string_view what) {
  throw InvalidArgument("this morsel was built without the kinds of files that libraries read, which " +
                        std::string(what) +
                        " needs: build it with -DMORSEL_WITH_FORMATS=ON, for which the "
                        "packages zlib1g-dev, liblzma-dev, libzstd-dev, libpugixml-dev, libtinygltf-dev and "
                        "nlohmann-json3-dev are needed");
}

LoadedSoup read_gltf(std::string_view, const std::string&, const Progress&) {
  require_formats("a glTF file");
  return {};
}

LoadedSoup read_gltf(std::string_view, const std::string&, const Progress&, const std::filesystem::path&) {
  require_formats("a glTF file");
  return {};
}

std::vector<std::filesystem::path> gltf_companions(const std::filesystem::path&) {
  return {};  // reading says why
}

LoadedSoup read_gifti(std::string_view, const std::string& file, const Progress&) {
  require_formats("the GIFTI file \"" + file + "\"");
  return {};
}

ValueFile read_gifti_values(std::string_view, const ValueRequest& request) {
  require_formats("the GIFTI file \"" + request.file + "\"");
  return {};
}

LoadedSoup read_vtk_xml(std::string_view, const std::string&, const Progress&) {
  require_formats("a VTP or VTU file");
  return {};
}

GrowingBytes decompress(std::string_view, Compression, const std::string& file, const Progress&,
                        const DecompressionLimit&) {
  require_formats("the compressed file \"" + file + "\"");
  return {};
}

}  // namespace morsel::core
