#pragma once
/// What FreeSurfer's binary files have in common. Internal.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace morsel::core {

/// The first three bytes of FreeSurfer's files.
enum class FreeSurferMagic : std::uint32_t {
  triangles = 0xFF'FFFE,       ///< a surface of triangles
  quads = 0xFF'FFFF,           ///< an old surface of quads, or values for vertices
  quads_of_floats = 0xFF'FFFD  ///< a surface of quads whose coordinates are not rounded
};

/// Whether the bytes begin as a surface of FreeSurfer's does: with the magic of triangles, or with one of
/// quads where they are not values. Its files have no extension of their own.
bool is_freesurfer_surface(std::string_view bytes);

/// Whether the bytes are values for vertices (lh.curv, lh.sulc, lh.thickness): by the magic that the new kind
/// has, which an old surface has, too, or by the size that the counts of the old kind require.
bool is_freesurfer_morphometry(std::string_view bytes);

/// Whether a file is named as FreeSurfer names surfaces: lh. or rh. and white, pial, orig, smoothwm,
/// inflated, sphere and others, with its suffixes (lh.sphere.reg, rh.pial.T1). Others of its files
/// (lh.sulc, lh.white.H, lh.aparc.annot) are none.
bool is_named_like_freesurfer_surface(const std::filesystem::path& path);

}  // namespace morsel::core
