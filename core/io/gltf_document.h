#pragma once
/// A glTF file before its scene is read: the parts of the binary form, and its JSON, checked. Internal to
/// gltf_reader.cpp, of the part FORMATS.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// Parts of a .glb file, or of a .gltf file, which has no binary part.
struct GltfContainer {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Throws BadInput if the binary form is damaged; adds a warning of bytes behind its end.
GltfContainer open_gltf(std::string_view bytes, const std::string& file, std::vector<std::string>& warnings);

/// The members of the JSON that the triangles need, with the types of what tinygltf passes over in silence
/// when they are wrong (indices, sizes and transforms) checked, and a limited depth and number of values.
/// Throws BadInput if it is damaged, breaks these rules, or is no object.
nlohmann::json checked_gltf_json(std::string_view text, const std::string& file, const Progress& progress);

/// The name of a file beside this one, of a buffer's URI. Throws BadInput if it is anything else.
std::string neighbour_name(const std::string& uri, const std::string& file);

/// One line of another library's message.
std::string one_line(std::string_view message);

}  // namespace morsel::core
