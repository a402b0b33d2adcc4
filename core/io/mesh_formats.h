#pragma once
/// The readers behind mesh_io.h, one source file a format. Internal.
///
/// Each reads a whole file from memory. `file` names it in errors. A reader takes what its format allows and
/// what programs commonly write, and refuses everything else with a BadInput that says what and where: a
/// damaged file must not pass for a whole one. Vertices come out in the order of the file and positions with
/// the precision the file has them in; corners are checked to name vertices that exist. A count in a header
/// is compared with the file's length before it is used.

#include <cstddef>
#include <string>
#include <string_view>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// Bytes of each piece of a text that is read in parallel: longer texts are cut. The readers that do so take
/// it as a parameter for the sake of tests.
inline constexpr std::size_t kTextChunk = std::size_t{1} << 16;

/// OFF and its variants COFF, NOFF, STOFF and their combinations, comments, polygons; header word missing or
/// joined to the counts. A vertex or face a line. Colours, normals and texture coordinates are skipped.
/// Binary OFF and 4OFF, nOFF (other dimensions than three) are refused.
LoadedSoup read_off(std::string_view bytes, const std::string& file, const Progress& progress);
LoadedSoup read_off(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk);

/// Wavefront OBJ: v and f with absolute or relative indices; other statements of the format are skipped.
LoadedSoup read_obj(std::string_view bytes, const std::string& file, const Progress& progress);
LoadedSoup read_obj(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk);

/// PLY, ASCII and binary of both byte orders. An ASCII value has the precision of its declared type, so that
/// the ASCII and the binary form of a file give the same mesh. Elements other than vertex and face are
/// skipped; triangle strips are refused.
LoadedSoup read_ply(std::string_view bytes, const std::string& file, const Progress& progress);

/// STL, ASCII and binary (told apart by the size, not by the word "solid"). Equal positions become one
/// vertex; vertices are numbered in the order in which they first appear. Normals are skipped.
LoadedSoup read_stl(std::string_view bytes, const std::string& file, const Progress& progress);

/// ESRI ASCII grid as a terrain (elevation_grid.h): ncols, nrows, xllcorner or xllcenter, yllcorner or
/// yllcenter, cellsize or dx and dy, NODATA_value (−9999 if missing) in any order and case, then the values
/// row by row from the north, in any white space. NaN is no data, too.
LoadedSoup read_asc(std::string_view bytes, const std::string& file, const Progress& progress);
LoadedSoup read_asc(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk);

}  // namespace morsel::core
