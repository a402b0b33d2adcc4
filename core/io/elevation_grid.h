#pragma once
/// Terrain: a grid of elevations as a mesh, for the readers of its formats. Internal.
///
/// Samples are vertices, at the centres of their cells, at the height of their value. The square of four
/// samples becomes two triangles, cut from its first to its last sample (upper left to lower right where
/// north is up), that of three samples with data the one triangle on them; other squares are empty. Samples
/// without data, and those that no triangle uses, are left out.
///
/// Where squares around a sample meet at that sample alone (two gaps that meet at a corner), the mesh would
/// not be a surface: the sample is split, as `--repair` would do it. The fan of its first triangle keeps the
/// number, and each other fan gets a vertex of its own at the same position, after all samples.
///
/// Vertices are numbered row by row, triangles by their squares, row by row. All triangles face up.

#include <cstddef>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

struct ElevationGrid {
  using Step = Eigen::Vector2d;
  std::size_t columns = 0;
  std::size_t rows = 0;
  Step first;                  ///< where the first sample of the first row is
  Step along_row;              ///< from a sample to the next one of its row
  Step to_next_row;            ///< from a sample to that of the next row
  std::vector<double> values;  ///< row by row; NaN where there are no data
  bool in_degrees = false;     ///< known to have longitudes and latitudes for positions
};

/// Throws the BadInput of `file` if `columns` × `rows` are no grid: fewer than two of either, or more samples
/// than vertices can be numbered.
void check_grid_size(std::size_t columns, std::size_t rows, const std::string& file);

/// The mesh, with the elevations as the vertex property `elevation`, and warnings with the numbers of samples
/// that were left out or split. Throws BadInput, naming `file`, if a value is infinite, if the steps are
/// parallel, or if there is no triangle. O(n), parallel; 85 bytes a sample at its peak, besides the values.
LoadedSoup make_terrain(ElevationGrid grid, const std::string& file, const Progress& progress);

}  // namespace morsel::core
