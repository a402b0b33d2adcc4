#pragma once
/// The readers behind mesh_io.h, one source file a format. Internal.
///
/// Each reads a whole file from memory. `file` names it in errors. A reader takes what its format allows and
/// what programs commonly write, says in warnings what is odd in a file whose content is complete, each kind
/// of oddity once with its number, and refuses everything else with a BadInput that says what and where: a
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
/// joined to the counts. A vertex or face a line or, where that gives no mesh, numbers on any lines: faces
/// without colours until the file ends, or else each beginning a line. Colours, normals and texture
/// coordinates are skipped; lines behind the announced faces are left out with a warning. Binary OFF and
/// 4OFF, nOFF (other dimensions than three) are refused.
LoadedSoup read_off(std::string_view bytes, const std::string& file, const Progress& progress);
LoadedSoup read_off(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk);

/// Wavefront OBJ: v and f with absolute or relative indices; other statements of the format are skipped.
LoadedSoup read_obj(std::string_view bytes, const std::string& file, const Progress& progress);
LoadedSoup read_obj(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk);

/// PLY, ASCII and binary of both byte orders. An ASCII value has the precision of its declared type, so that
/// the ASCII and the binary form of a file give the same mesh. Triangle strips become triangles; elements
/// other than these, vertex and face are skipped. With warnings: longer lines of faces, whole numbers with
/// decimals that are 0, corners of a floating-point type, what follows the last element.
LoadedSoup read_ply(std::string_view bytes, const std::string& file, const Progress& progress);

/// FreeSurfer's surfaces: triangles, and the two old kinds with quads. Coordinates are those of the file
/// ("surface RAS"): the geometry of the volume that may follow is not applied.
LoadedSoup read_freesurfer(std::string_view bytes, const std::string& file, const Progress& progress);

/// GIFTI: one array of points and one of triangles, as text, in base64, compressed, in either byte order.
/// Coordinates are those of the file: transformations in it are not applied. Arrays of one value a vertex
/// are properties. Of the part FORMATS.
LoadedSoup read_gifti(std::string_view bytes, const std::string& file, const Progress& progress);

/// STL, ASCII and binary (told apart by the size, not by the word "solid"). Equal positions become one
/// vertex; vertices are numbered in the order in which they first appear. Normals are skipped. With warnings:
/// bytes behind the triangles or the number 0 in a binary file, text behind a solid.
LoadedSoup read_stl(std::string_view bytes, const std::string& file, const Progress& progress);

/// VTK's legacy format, ASCII and binary, versions 1 to 5: POLYDATA, and UNSTRUCTURED_GRID of faces. Arrays
/// of points and cells become properties, one for each component; lines and vertices are left out with a
/// warning; solid cells are refused. Numbers of a text have the precision of their type.
LoadedSoup read_vtk(std::string_view bytes, const std::string& file, const Progress& progress);

/// The same for VTK's XML formats, PolyData and UnstructuredGrid: arrays in text, in base64 and appended, raw
/// or compressed by zlib. Needs the part FORMATS.
LoadedSoup read_vtk_xml(std::string_view bytes, const std::string& file, const Progress& progress);
/// ESRI ASCII grid as a terrain (elevation_grid.h): ncols, nrows, xllcorner or xllcenter, yllcorner or
/// yllcenter, cellsize or dx and dy, NODATA_value (−9999 if missing) in any order and case, then the values
/// row by row from the north, in any white space. NaN is no data, too.
LoadedSoup read_asc(std::string_view bytes, const std::string& file, const Progress& progress);
LoadedSoup read_asc(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk);

}  // namespace morsel::core
