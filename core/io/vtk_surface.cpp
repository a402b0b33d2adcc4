#include "morsel/core/io/vtk_surface.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_set>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/oddities.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core::vtk {
namespace {

constexpr std::size_t kPause = 1 << 16;  // elements between two checks for cancellation

struct TypeName {
  std::string_view name;
  NumberType type;
};
constexpr auto kTypeNames = std::to_array<TypeName>({{"Int8", NumberType::int8},
                                                     {"UInt8", NumberType::uint8},
                                                     {"Int16", NumberType::int16},
                                                     {"UInt16", NumberType::uint16},
                                                     {"Int32", NumberType::int32},
                                                     {"UInt32", NumberType::uint32},
                                                     {"Int64", NumberType::int64},
                                                     {"UInt64", NumberType::uint64},
                                                     {"Float32", NumberType::float32},
                                                     {"Float64", NumberType::float64}});

enum class CellKind { none, vertex, line, face, curved, solid };

struct CellName {
  std::int64_t type;
  CellKind kind;
  std::string_view name;
};
/// VTK's cell types (vtkCellType.h).
constexpr auto kCells = std::to_array<CellName>({
    {0, CellKind::none, "an empty cell"},
    {1, CellKind::vertex, "a vertex"},
    {2, CellKind::vertex, "a poly-vertex"},
    {3, CellKind::line, "a line"},
    {4, CellKind::line, "a polyline"},
    {5, CellKind::face, "a triangle"},
    {6, CellKind::face, "a triangle strip"},
    {7, CellKind::face, "a polygon"},
    {8, CellKind::face, "a pixel"},
    {9, CellKind::face, "a quad"},
    {10, CellKind::solid, "a tetrahedron"},
    {11, CellKind::solid, "a voxel"},
    {12, CellKind::solid, "a hexahedron"},
    {13, CellKind::solid, "a wedge"},
    {14, CellKind::solid, "a pyramid"},
    {15, CellKind::solid, "a pentagonal prism"},
    {16, CellKind::solid, "a hexagonal prism"},
    {21, CellKind::line, "a quadratic edge"},
    {22, CellKind::curved, "a quadratic triangle"},
    {23, CellKind::curved, "a quadratic quad"},
    {24, CellKind::solid, "a quadratic tetrahedron"},
    {25, CellKind::solid, "a quadratic hexahedron"},
    {26, CellKind::solid, "a quadratic wedge"},
    {27, CellKind::solid, "a quadratic pyramid"},
    {28, CellKind::curved, "a biquadratic quad"},
    {29, CellKind::solid, "a triquadratic hexahedron"},
    {30, CellKind::curved, "a quadratic linear quad"},
    {31, CellKind::solid, "a quadratic linear wedge"},
    {32, CellKind::solid, "a biquadratic quadratic wedge"},
    {33, CellKind::solid, "a biquadratic quadratic hexahedron"},
    {34, CellKind::curved, "a biquadratic triangle"},
    {35, CellKind::line, "a cubic line"},
    {36, CellKind::curved, "a quadratic polygon"},
    {37, CellKind::solid, "a triquadratic pyramid"},
    {41, CellKind::solid, "a convex point set"},
    {42, CellKind::solid, "a polyhedron"},
    {60, CellKind::line, "a higher-order edge"},
    {61, CellKind::curved, "a higher-order triangle"},
    {62, CellKind::curved, "a higher-order quad"},
    {63, CellKind::curved, "a higher-order polygon"},
    {64, CellKind::solid, "a higher-order tetrahedron"},
    {65, CellKind::solid, "a higher-order wedge"},
    {66, CellKind::solid, "a higher-order pyramid"},
    {67, CellKind::solid, "a higher-order hexahedron"},
    {68, CellKind::line, "a Lagrange curve"},
    {69, CellKind::curved, "a Lagrange triangle"},
    {70, CellKind::curved, "a Lagrange quad"},
    {71, CellKind::solid, "a Lagrange tetrahedron"},
    {72, CellKind::solid, "a Lagrange hexahedron"},
    {73, CellKind::solid, "a Lagrange wedge"},
    {74, CellKind::solid, "a Lagrange pyramid"},
    {75, CellKind::line, "a Bezier curve"},
    {76, CellKind::curved, "a Bezier triangle"},
    {77, CellKind::curved, "a Bezier quad"},
    {78, CellKind::solid, "a Bezier tetrahedron"},
    {79, CellKind::solid, "a Bezier hexahedron"},
    {80, CellKind::solid, "a Bezier wedge"},
    {81, CellKind::solid, "a Bezier pyramid"},
});

const CellName* find_cell(std::int64_t type) {
  const auto* found = std::ranges::lower_bound(kCells, type, {}, &CellName::type);
  return found != kCells.end() && found->type == type ? found : nullptr;
}

constexpr std::int64_t kTriangle = 5;
constexpr std::int64_t kPixel = 8;
constexpr std::int64_t kQuad = 9;

}  // namespace

std::optional<NumberType> number_type(std::string_view name) {
  const auto* found = std::ranges::find(kTypeNames, name, &TypeName::name);
  if (found == kTypeNames.end()) return {};
  return found->type;
}

void SurfaceBuilder::add_points(const std::vector<double>& coordinates) {
  if (coordinates.size() % 3 != 0)
    fail_reading(file_,
                 "its " + std::to_string(coordinates.size()) + " coordinates are not three for each point");
  std::vector<Point>& positions = result_.soup.positions;
  const std::size_t first = positions.size();
  const std::size_t count = coordinates.size() / 3;
  if (count >= kNone - first) fail_reading(file_, "it has more points than can be numbered");
  positions.resize(first + count);  // grows by a factor where needed, unlike reserve(): pieces may be many
  for (std::size_t i = 0; i < count; ++i)
    positions[first + i] = {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
}

void SurfaceBuilder::add_cells(const Cells& cells, CellType type, std::size_t first) {
  add(
      cells, [type](std::size_t) { return static_cast<std::int64_t>(type); }, first);
}

void SurfaceBuilder::add_cells(const Cells& cells, const std::vector<std::int64_t>& types,
                               std::size_t first) {
  if (types.size() != cells.ends.size())
    fail_reading(file_, "it has " + std::to_string(cells.ends.size()) + " cells, but " +
                            std::to_string(types.size()) + " types of cells");
  add(
      cells, [&types](std::size_t i) { return types[i]; }, first);
}

void SurfaceBuilder::warn(std::string sentence) { result_.warnings.push_back(std::move(sentence)); }

template <class TypeOf>
void SurfaceBuilder::add(const Cells& cells, const TypeOf& type_of, std::size_t first) {
  std::int64_t begin = 0;
  for (std::size_t i = 0; i < cells.ends.size(); ++i, ++cell_count_) {
    if (i % kPause == 0)
      progress_.update("reading the mesh", static_cast<double>(i) / static_cast<double>(cells.ends.size()));
    const std::int64_t end = cells.ends[i];
    if (end < begin || static_cast<std::uint64_t>(end) > cells.connectivity.size())
      fail_reading(file_, "cell " + std::to_string(cell_count_) + " ends at corner " + std::to_string(end) +
                              ", but it begins at " + std::to_string(begin) + " and there are " +
                              std::to_string(cells.connectivity.size()) + " corners");
    const std::int64_t type = type_of(i);
    const CellName* cell = find_cell(type);
    if (cell == nullptr)
      fail_reading(file_, "cell " + std::to_string(cell_count_) + " is of type " + std::to_string(type) +
                              ", which is none of VTK's");
    switch (cell->kind) {
      case CellKind::vertex:
        ++vertices_;
        break;
      case CellKind::line:
        ++lines_;
        break;
      case CellKind::solid:
        if (solids_++ == 0) first_solid_ = cell_count_;
        solid_name_ = solids_ == 1 ? cell->name : solid_name_;
        break;
      case CellKind::curved:
        fail_reading(file_, "cell " + std::to_string(cell_count_) + " is " + std::string(cell->name) +
                                ", whose sides are curved: faces with straight sides are read");
      case CellKind::face:
        add_face(type, cells.connectivity.data() + begin, static_cast<std::size_t>(end - begin), first);
        break;
      case CellKind::none:
        break;
    }
    begin = end;
  }
  if (static_cast<std::uint64_t>(begin) != cells.connectivity.size())
    fail_reading(file_, "its cells have " + std::to_string(begin) + " corners, but it lists " +
                            std::to_string(cells.connectivity.size()));
}

void SurfaceBuilder::add_corner(std::int64_t corner, std::size_t first) {
  const std::size_t points = point_count() - first;
  if (corner < 0 || static_cast<std::uint64_t>(corner) >= points)
    fail_reading(file_, "cell " + std::to_string(cell_count_) + " names point " + std::to_string(corner) +
                            ", but there are only " + std::to_string(points) + " points, numbered from 0");
  result_.soup.corners.push_back(static_cast<Index>(first + static_cast<std::size_t>(corner)));
}

void SurfaceBuilder::end_polygon() {
  result_.soup.offsets.push_back(result_.soup.corners.size());
  cell_of_polygon_.push_back(cell_count_);
}

void SurfaceBuilder::add_face(std::int64_t type, const std::int64_t* corners, std::size_t count,
                              std::size_t first) {
  const std::size_t expected = type == kTriangle ? 3 : type == kPixel || type == kQuad ? 4 : 0;
  if ((expected > 0 && count != expected) || (type == kTriangleStrip && count < 3))
    fail_reading(file_, "cell " + std::to_string(cell_count_) + " is " + std::string(find_cell(type)->name) +
                            " with " + std::to_string(count) + (count == 1 ? " corner" : " corners"));
  if (type == kTriangleStrip) {
    for (std::size_t i = 0; i + 2 < count; ++i) {
      add_corner(corners[i + i % 2], first);
      add_corner(corners[i + 1 - i % 2], first);
      add_corner(corners[i + 2], first);
      end_polygon();
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i)  // a pixel's corners go by x and y, not round it
    add_corner(corners[type == kPixel && i > 1 ? 5 - i : i], first);
  end_polygon();
}

void SurfaceBuilder::check_kinds() const {
  if (solids_ == 0) return;
  fail_reading(file_, "it is a volume mesh: " + std::to_string(solids_) + " of its " +
                          std::to_string(cell_count_) + " cells are solid (cell " +
                          std::to_string(first_solid_) + " is " + std::string(solid_name_) +
                          "); extract its surface first (in ParaView by the filter Extract Surface)");
}

std::vector<double> SurfaceBuilder::by_polygon(const std::vector<double>& values, std::size_t components,
                                               std::size_t component) const {
  std::vector<double> result(cell_of_polygon_.size());
  for (std::size_t p = 0; p < result.size(); ++p)
    result[p] = values[cell_of_polygon_[p] * components + component];
  return result;
}

std::vector<VertexProperty> SurfaceBuilder::properties(std::vector<Array> arrays, bool of_cells) {
  constexpr std::size_t kMostComponents = 16;
  const std::size_t tuples = of_cells ? cell_count_ : point_count();
  std::vector<VertexProperty> result;
  std::unordered_set<std::string> arrays_before, properties_before;
  for (Array& array : arrays) {
    progress_.throw_if_cancelled();
    const std::string name = array.name.empty() ? "unnamed" : array.name;
    const std::string what = "the array " + shown(name) + " of its " + (of_cells ? "cells" : "points");
    if (array.components == 0 || array.components > kMostComponents) {
      warn(what + " has " + std::to_string(array.components) + " components and was left out (at most " +
           std::to_string(kMostComponents) + " are read)");
      continue;
    }
    if (!arrays_before.insert(name).second) {
      warn(what + " comes twice; the second one was left out");
      continue;
    }
    if (array.values.size() != tuples * array.components)
      fail_reading(file_, what + " has " + std::to_string(array.values.size()) + " numbers, not " +
                              std::to_string(tuples) + " times " + std::to_string(array.components));
    for (std::size_t k = 0; k < array.components; ++k) {
      VertexProperty property{array.components == 1 ? name : name + ":" + std::to_string(k), {}};
      if (!properties_before.insert(property.name).second) {
        warn(what + " has the component " + shown(property.name) +
             ", which another array has, too; the second one was left out");
        continue;
      }
      if (of_cells) {
        property.values = by_polygon(array.values, array.components, k);
      } else if (array.components == 1) {
        property.values = std::move(array.values);
      } else {
        property.values.resize(tuples);
        for (std::size_t i = 0; i < tuples; ++i) property.values[i] = array.values[i * array.components + k];
      }
      result.push_back(std::move(property));
    }
    array.values = {};
  }
  return result;
}

LoadedSoup SurfaceBuilder::finish(std::vector<Array> point_arrays, std::vector<Array> cell_arrays) {
  check_kinds();
  if (vertices_ + lines_ > 0) {
    const std::string vertices = counted(vertices_, "vertex cell");
    const std::string lines = counted(lines_, "line");
    warn((vertices_ == 0 ? lines
          : lines_ == 0  ? vertices
                         : vertices + " and " + lines) +
         (vertices_ + lines_ == 1 ? " was" : " were") + " left out: faces are read");
  }
  result_.properties = properties(std::move(point_arrays), false);
  result_.face_properties = properties(std::move(cell_arrays), true);
  return std::move(result_);
}

}  // namespace morsel::core::vtk
