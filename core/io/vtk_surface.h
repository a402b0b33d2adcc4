#pragma once
/// What the readers of VTK's formats share: types by name, cells, arrays of points and cells. Internal.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/io/number_type.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core::vtk {

/// The type of VTK's XML files ("Int8", …, "Float64").
std::optional<NumberType> number_type(std::string_view name);

/// Cells of a file: cell i has the points connectivity[ends[i − 1]] … connectivity[ends[i] − 1].
struct Cells {
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> ends;
};

/// Numbers of an array, tuple by tuple.
struct Array {
  std::string name;
  std::size_t components = 1;
  std::vector<double> values;
};

/// VTK's numbers of the cells of polydata.
enum CellType : std::int64_t { kPolyVertex = 2, kPolyLine = 4, kTriangleStrip = 6, kPolygon = 7 };

/// Gathers the faces of a surface and its arrays. Lines and vertices are left out with a warning; solid cells
/// and curved faces are refused.
class SurfaceBuilder {
 public:
  /// Keeps references.
  SurfaceBuilder(const std::string& file, const Progress& progress) : file_(file), progress_(progress) {}

  std::size_t point_count() const { return result_.soup.positions.size(); }
  std::size_t cell_count() const { return cell_count_; }

  /// x y z of each point, after those that there are.
  void add_points(const std::vector<double>& coordinates);
  /// Cells of one type, whose points are numbered from the point `first` on and lie before the last one.
  void add_cells(const Cells& cells, CellType type, std::size_t first = 0);
  /// Cells with a type each.
  void add_cells(const Cells& cells, const std::vector<std::int64_t>& types, std::size_t first = 0);
  void warn(std::string sentence);

  /// The soup. A component of an array becomes a property: NAME, or NAME:0, NAME:1, … of several.
  LoadedSoup finish(std::vector<Array> point_arrays, std::vector<Array> cell_arrays);

 private:
  template <class TypeOf>
  void add(const Cells& cells, const TypeOf& type_of, std::size_t first);
  void add_face(std::int64_t type, const std::int64_t* corners, std::size_t count, std::size_t first);
  void add_corner(std::int64_t corner, std::size_t first);
  void end_polygon();
  void check_kinds() const;
  std::vector<VertexProperty> properties(std::vector<Array> arrays, bool of_cells);
  std::vector<double> by_polygon(const std::vector<double>& values, std::size_t components,
                                 std::size_t component) const;

  const std::string& file_;
  const Progress& progress_;
  LoadedSoup result_;
  std::vector<std::size_t> cell_of_polygon_;
  std::size_t cell_count_ = 0;
  // Cells that are no faces.
  std::size_t lines_ = 0;
  std::size_t vertices_ = 0;
  std::size_t solids_ = 0;
  std::size_t first_solid_ = 0;
  std::string_view solid_name_;
};

}  // namespace morsel::core::vtk
