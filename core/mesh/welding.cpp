#include "morsel/core/mesh/welding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/hash_index.h"
#include "morsel/core/parallel/interruptible.h"
#include "morsel/core/text/numbers.h"

namespace morsel::core {
namespace {

using Cell = std::array<double, 3>;

/// The keys of a HashIndex of cells, whose entries are their numbers.
struct CellKeys {
  static constexpr Index kFree = kNone;
  const std::vector<Cell>& cells;

  static std::size_t hash(const Cell& cell) {
    std::uint64_t hash = 0;
    for (const double x : cell) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E37'79B9'7F4A'7C15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
  const Cell& key(Index c) const { return cells[c]; }
  static bool equal(const Cell& a, const Cell& b) { return a == b; }
  static bool less(const Cell& a, const Cell& b) { return a < b; }
};

/// Numbers for cells in the order in which they first appear.
class CellIndex {
 public:
  CellIndex() = default;
  CellIndex(const CellIndex&) = delete;  // the keys refer to cells_
  CellIndex& operator=(const CellIndex&) = delete;
  /// kNone if the cell was not added.
  Index find(const Cell& cell) const { return index_.find(cell); }
  Index add(const Cell& cell) {
    const Index known = index_.find(cell);
    if (known != kNone) return known;
    const auto added = static_cast<Index>(cells_.size());
    cells_.push_back(cell);
    index_.insert(added);
    return added;
  }

 private:
  std::vector<Cell> cells_;
  HashIndex<Index, CellKeys> index_{CellKeys{cells_}};
};

void tell_search(const Progress& progress, std::size_t v, std::size_t count) {
  if ((v & 0xFFFF) == 0xFFFF)
    progress.update("finding coincident vertices", static_cast<double>(v) / static_cast<double>(count));
}

std::vector<Index> join_equal(std::span<const Point> positions, const Progress& progress) {
  std::vector<Index> joined(positions.size());
  std::vector<Index> first_in;  // per cell: the first vertex there
  CellIndex cells;
  for (Index v = 0; v < joined.size(); ++v) {
    tell_search(progress, v, joined.size());
    joined[v] = v;
    const Point& p = positions[v];
    if (!p.allFinite()) continue;
    const Index cell = cells.add({p.x() + 0.0, p.y() + 0.0, p.z() + 0.0});  // −0 and 0 are the same place
    if (cell == first_in.size())
      first_in.push_back(v);
    else
      joined[v] = first_in[cell];
  }
  return joined;
}

/// Representatives in the cells of a grid. Cells are four lengths wide, so that those within a length of a
/// position lie in few of them, and a cell holds a bounded number of representatives, which are farther
/// apart.
class Representatives {
 public:
  /// `extent`: the largest coordinate, by which cells are limited to what a number can hold.
  Representatives(std::span<const Point> positions, double length, double extent)
      : positions_(positions),
        length_(length),
        reach_(length * (1 + 1e-9)),  // a distance is rounded, too
        side_(std::max(4 * length, std::ldexp(extent, -1000))) {}

  /// The smallest one within the length of vertex v, which becomes one itself if there is none.
  Index join(Index v) {
    const Point& p = positions_[v];
    Cell low, high;
    for (int axis = 0; axis < 3; ++axis) {
      // Differences, quotients and floors are monotone, so a coordinate within reach lies between these two.
      low[axis] = cell_of(p[axis] - reach_);
      high[axis] = cell_of(p[axis] + reach_);
    }
    Index smallest = kNone;
    for (double x = low[0];; x = following(x, high[0])) {
      for (double y = low[1];; y = following(y, high[1])) {
        for (double z = low[2];; z = following(z, high[2])) {
          smallest = std::min(smallest, find({x, y, z}, p));
          if (z == high[2]) break;
        }
        if (y == high[1]) break;
      }
      if (x == high[0]) break;
    }
    if (smallest != kNone) return smallest;
    const Index cell = cells_.add({cell_of(p.x()), cell_of(p.y()), cell_of(p.z())});
    if (cell == last_in_.size()) last_in_.push_back(kNone);
    vertices_.emplace_back(v, last_in_[cell]);
    last_in_[cell] = static_cast<Index>(vertices_.size() - 1);
    return v;
  }

 private:
  double cell_of(double coordinate) const { return std::floor(coordinate / side_) + 0.0; }
  /// Beyond 2⁵³ cells are as far apart as numbers are.
  static double following(double cell, double last) {
    return std::min(last, std::max(cell + 1, std::nextafter(cell, std::numeric_limits<double>::infinity())));
  }
  Index find(const Cell& cell, const Point& p) const {
    const Index number = cells_.find(cell);
    if (number == kNone) return kNone;
    Index smallest = kNone;
    for (Index i = last_in_[number]; i != kNone; i = vertices_[i].second) {
      const auto& q = positions_[vertices_[i].first];
      if (std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()) <= length_)
        smallest = std::min(smallest, vertices_[i].first);
    }
    return smallest;
  }

  std::span<const Point> positions_;
  double length_, reach_, side_;
  CellIndex cells_;
  std::vector<Index> last_in_;                     // per cell: its last entry of vertices_
  std::vector<std::pair<Index, Index>> vertices_;  // with the entry before it in the same cell
};

constexpr double kLargestExtent = 1e300;

/// Of the vertices that are finite.
double largest_coordinate(std::span<const Point> positions) {
  double largest = 0;
  for (const Point& p : positions)
    if (p.allFinite()) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

std::size_t count_different(std::vector<Index>& vertices) {
  std::sort(vertices.begin(), vertices.end());
  return static_cast<std::size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
}

/// Removes repeated corners, and sides that are run back and forth.
void reduce(std::span<const Index> polygon, std::vector<Index>& ring) {
  ring.clear();
  for (const Index v : polygon) {
    if (!ring.empty() && ring.back() == v) continue;
    if (ring.size() >= 2 && ring[ring.size() - 2] == v)
      ring.pop_back();
    else
      ring.push_back(v);
  }
  std::size_t first = 0;
  while (ring.size() - first > 2) {  // where the ends meet
    const std::size_t last = ring.size() - 1;
    if (ring[last] == ring[first]) {
      ring.pop_back();
    } else if (ring[last - 1] == ring[first]) {  // "a … a b"
      ring.resize(last - 1);
    } else if (ring[last] == ring[first + 1]) {  // "b a … a"
      ring.pop_back();
      ++first;
    } else {
      break;
    }
  }
  ring.erase(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

std::vector<Index> coincident_vertices(std::span<const Point> positions, double length,
                                       const Progress& progress) {
  if (!(length >= 0) || !std::isfinite(length))
    throw InvalidArgument("vertices cannot be joined within the length " + shortest(length));
  if (length == 0) return join_equal(positions, progress);
  const double extent = largest_coordinate(positions);
  if (extent > kLargestExtent)
    throw BadInput("vertices whose coordinates are as large as " + shortest(extent) +
                   " cannot be joined within a length");
  // No two positions are four extents apart; with less, cells are finite.
  length = std::min(length, extent > 0 ? 4 * extent : 1);
  Representatives representatives(positions, length, extent);
  std::vector<Index> joined(positions.size());
  for (Index v = 0; v < joined.size(); ++v) {
    tell_search(progress, v, joined.size());
    joined[v] = positions[v].allFinite() ? representatives.join(v) : v;
  }
  return joined;
}

double length_on(const Length& length, const PolygonSoup& soup) {
  const auto position = [&](Index v) -> const Point* {
    return v < soup.positions.size() && soup.positions[v].allFinite() ? &soup.positions[v] : nullptr;
  };
  switch (length.unit) {
    case LengthUnit::epsilon:
    case LengthUnit::percent: {
      const double share = length.unit == LengthUnit::epsilon ? 0.003 : 0.01;
      Eigen::AlignedBox3d box;
      for (const Point& p : soup.positions)
        if (p.allFinite()) box.extend(p);
      return box.isEmpty() ? 0 : length.value * share * box.diagonal().stableNorm();
    }
    case LengthUnit::edge: {
      double sum = 0;
      std::size_t count = 0;
      for (std::size_t p = 0; p < soup.polygon_count(); ++p) {
        const std::span<const Index> polygon = soup.polygon(p);
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const Point* from = position(polygon[i]);
          const Point* to = position(polygon[(i + 1) % polygon.size()]);
          if (from == nullptr || to == nullptr) continue;
          sum += (*to - *from).stableNorm();
          ++count;
        }
      }
      return count == 0 ? 0 : length.value * (sum / static_cast<double>(count));
    }
    case LengthUnit::root_area: {
      double sum = 0;
      for (std::size_t p = 0; p < soup.polygon_count(); ++p) {
        // Corners are checked only where the mesh is built.
        if (!std::ranges::all_of(soup.polygon(p), [&](Index v) { return position(v) != nullptr; })) continue;
        const double area = soup.area(p);
        if (std::isfinite(area)) sum += area;
      }
      return length.value * std::sqrt(sum);
    }
    default:
      return length.value;
  }
}

WeldedSoup weld(PolygonSoup soup, double length, const Progress& progress) {
  const std::size_t count = soup.positions.size();
  std::vector<Index> joined = coincident_vertices(soup.positions, length, progress);
  WeldedSoup result;
  result.numbering.input_count = count;
  std::vector<Index> to_input;
  for (Index v = 0; v < count; ++v)
    if (joined[v] == v) to_input.push_back(v);
  result.joined = count - to_input.size();
  if (result.joined == 0) {
    result.soup = std::move(soup);
    return result;
  }
  std::vector<Index> from_input = std::move(joined);
  for (Index v = 0, kept = 0; v < count; ++v)  // a representative comes before those that join it
    from_input[v] = from_input[v] == v ? kept++ : from_input[from_input[v]];
  for (std::size_t v = 0; v < to_input.size(); ++v) soup.positions[v] = Point(soup.positions[to_input[v]]);
  soup.positions.resize(to_input.size());

  std::vector<Index> before, after, ring;
  std::size_t end = 0;  // of the corners that are kept, which never overtake those that are read
  for (std::size_t p = 0, begin = 0; p < soup.polygon_count(); ++p) {
    throw_if_stopped_at_times();
    const std::span<Index> polygon =
        std::span<Index>(soup.corners).subspan(begin, soup.offsets[p + 1] - begin);
    begin = soup.offsets[p + 1];
    before.assign(polygon.begin(), polygon.end());
    bool is_damaged = false;
    for (Index& v : polygon) {
      is_damaged = is_damaged || v >= count;
      v = v < count ? from_input[v] : kNone;
    }
    after.assign(polygon.begin(), polygon.end());
    ring = after;
    if (const std::size_t different = count_different(before);
        !is_damaged && count_different(after) < different) {
      reduce(polygon, ring);
      if (ring.size() < 3 && different >= 3) {
        result.collapsed.resize(soup.polygon_count(), false);
        result.collapsed[p] = true;
        ++result.collapsed_count;
        ring.clear();
      }
    }
    std::copy(ring.begin(), ring.end(), soup.corners.begin() + static_cast<std::ptrdiff_t>(end));
    end += ring.size();
    soup.offsets[p + 1] = end;
  }
  soup.corners.resize(end);
  result.soup = std::move(soup);
  result.numbering.to_input = std::move(to_input);
  result.numbering.from_input = std::move(from_input);
  return result;
}

Index count_unwelded(const TriangleMesh& mesh, const VertexNumbering& numbering, const Progress& progress) {
  if (mesh.is_closed()) return 0;
  std::vector<Index> vertices;
  for (Index k = 0; k < mesh.boundary_loop_count(); ++k)
    for (const Index h : mesh.boundary_loop(k)) vertices.push_back(mesh.origin(h));
  std::sort(vertices.begin(), vertices.end(), interruptible());
  std::vector<Point> positions;
  positions.reserve(vertices.size());
  for (const Index v : vertices) positions.push_back(mesh.position(v));
  const std::vector<Index> joined = coincident_vertices(positions, 0, progress);
  const auto group_of = [&](Index v) {
    return joined[static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                           vertices.begin())];
  };
  // A boundary edge by the groups of its ends, and by its vertices in the input.
  struct Side {
    std::array<Index, 2> groups, inputs;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  for (Index k = 0; k < mesh.boundary_loop_count(); ++k)
    for (const Index h : mesh.boundary_loop(k)) {
      Index a = mesh.origin(h), b = mesh.target(h);
      const Index group_a = group_of(a), group_b = group_of(b);
      if (group_a == group_b) continue;
      if (group_a > group_b) std::swap(a, b);
      sides.push_back({{std::min(group_a, group_b), std::max(group_a, group_b)},
                       {numbering.input_vertex(a), numbering.input_vertex(b)}});
    }
  std::sort(sides.begin(), sides.end(), interruptible());
  std::vector<std::array<Index, 2>> ends;  // group and input vertex
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].groups == sides[first].groups) ++last;
    if (sides[last - 1].inputs == sides[first].inputs) continue;
    for (std::size_t i = first; i < last; ++i)
      for (int e : {0, 1}) ends.push_back({sides[i].groups[e], sides[i].inputs[e]});
  }
  std::sort(ends.begin(), ends.end(), interruptible());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  Index count = 0;
  for (std::size_t i = 1; i < ends.size(); ++i) count += ends[i][0] == ends[i - 1][0] ? 1 : 0;
  return count;
}

std::string unwelded_warning(const TriangleMesh& mesh, const VertexNumbering& numbering,
                             const Progress& progress) {
  const Index count = count_unwelded(mesh, numbering, progress);
  if (count == 0) return {};
  return grouped(count) + " of " + grouped(mesh.vertex_count()) +
         (count == 1 ? " vertices coincides" : " vertices coincide") +
         " with others, so that faces are not joined there; welding (--weld) joins them";
}

JoinedDifference compare_joined(const VertexNumbering& numbering, std::span<const double> values) {
  JoinedDifference difference;
  if (numbering.from_input.empty()) return difference;
  if (values.size() != numbering.from_input.size())
    throw InvalidArgument(std::to_string(values.size()) + " values for " +
                          std::to_string(numbering.from_input.size()) + " vertices of the input");
  for (Index v = 0; v < values.size(); ++v) {
    const Index at = numbering.from_input[v];
    if (at == kNone) continue;
    const double taken = values[numbering.to_input[at]];
    if (values[v] == taken || (std::isnan(values[v]) && std::isnan(taken))) continue;
    ++difference.count;
    const double distance = std::abs(values[v] - taken);
    if (std::isfinite(distance)) difference.largest = std::max(difference.largest, distance);
  }
  return difference;
}

}  // namespace morsel::core
