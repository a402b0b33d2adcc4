#pragma once
/// The header of a PLY file. Internal.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "morsel/core/text/text_scanner.h"

namespace morsel::core::ply {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// In bytes of a binary body.
inline std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

inline bool is_whole(Type type) { return type != Type::float32 && type != Type::float64; }

struct Property {
  std::string name;
  Type type = Type::float32;
  bool is_list = false;
  Type count_type = Type::uint8;  ///< of a list's length
};

/// Whether it is a list of the corners of faces, by its name.
inline bool is_corner_list(const Property& p) {
  return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
}

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  std::string plural() const {
    return name == "vertex" ? "vertices" : name.ends_with('s') ? name : name + "s";
  }
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

/// The header of a mesh. The scanner starts at the beginning of the file and is at the end of the header's
/// last line afterwards. Throws a BadInput that names `file` if this is no PLY header, or the header of
/// something else than a mesh.
Header read_header(TextScanner& scanner, const std::string& file);

}  // namespace morsel::core::ply
