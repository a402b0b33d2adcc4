#include "morsel/core/mesh/mesh_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "morsel/core/mesh/mesh_repair.h"
#include "morsel/core/mesh/polygon_triangulation.h"
#include "morsel/core/mesh/vertex_removal.h"
#include "morsel/core/mesh/welding.h"
#include "morsel/core/parallel/interruptible.h"
#include "morsel/core/text/numbers.h"

namespace morsel::core {
namespace {

enum class PolygonState : unsigned char { sound, out_of_range, degenerate, duplicate, collapsed };

bool has_repeated_corner(std::span<const Index> polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (polygon[i] == polygon[(i + 1) % polygon.size()]) return true;
  return false;
}

/// The polygon without consecutive corners on the same vertex.
void merge_repeated(std::span<const Index> polygon, std::vector<Index>& result) {
  result.clear();
  for (const Index v : polygon)
    if (result.empty() || result.back() != v) result.push_back(v);
  while (result.size() > 1 && result.back() == result.front()) result.pop_back();
}

/// Turns polygons into triangles. A defect of a polygon becomes triangles with the same defect, so that
/// find_defects() reports it, or is repaired.
class Triangulation {
 public:
  /// `collapsed`: polygons that are no face any more; empty if there are none.
  Triangulation(PolygonSoup soup, const std::vector<bool>& collapsed, bool repair, const Progress& progress)
      : soup_(std::move(soup)), collapsed_(collapsed), repair_(repair), progress_(progress) {}

  TriangleSoup run(RepairCounts& counts) {
    const std::size_t count = soup_.polygon_count();
    bool only_triangles = true;
    for (std::size_t p = 0; p < count && only_triangles; ++p) only_triangles = soup_.polygon(p).size() == 3;
    if (only_triangles) {
      result_.triangles.resize(count);
      for (std::size_t p = 0; p < count; ++p)
        std::copy_n(soup_.corners.begin() + static_cast<std::ptrdiff_t>(3 * p), 3,
                    result_.triangles[p].begin());
    } else {
      if (repair_) merge_corners(counts);
      classify();
      for (std::size_t p = 0; p < count; ++p) {
        if ((p & 0xFFFF) == 0xFFFF)
          progress_.update("triangulating polygons", static_cast<double>(p) / static_cast<double>(count));
        append(p);
      }
    }
    result_.positions = std::move(soup_.positions);
    return std::move(result_);
  }

 private:
  void merge_corners(RepairCounts& counts) {
    std::vector<Index> merged;
    std::vector<Index> corners;
    std::vector<std::size_t> offsets = {0};
    for (std::size_t p = 0; p < soup_.polygon_count(); ++p) {
      merge_repeated(soup_.polygon(p), merged);
      if (merged.size() >= 3 && merged.size() < soup_.polygon(p).size()) ++counts.merged_repeated_corners;
      corners.insert(corners.end(), merged.begin(), merged.end());
      offsets.push_back(corners.size());
    }
    soup_.corners = std::move(corners);
    soup_.offsets = std::move(offsets);
  }

  void classify() {
    const std::size_t n = soup_.positions.size();
    state_.assign(soup_.polygon_count(), PolygonState::sound);
    for (std::size_t p = 0; p < state_.size(); ++p) {
      const auto polygon = soup_.polygon(p);
      if (!collapsed_.empty() && collapsed_[p])
        state_[p] = PolygonState::collapsed;
      else if (std::any_of(polygon.begin(), polygon.end(), [&](Index v) { return v >= n; }))
        state_[p] = PolygonState::out_of_range;
      else if (polygon.size() < 3 || has_repeated_corner(polygon))
        state_[p] = PolygonState::degenerate;
    }
    find_duplicates();
    for (std::size_t p = 0; p < state_.size(); ++p) {
      if (state_[p] != PolygonState::sound) continue;
      progress_.throw_if_cancelled();
      const auto polygon = soup_.polygon(p);
      for (std::size_t i = 0; i < polygon.size(); ++i)
        edges_.insert(polygon[i], polygon[(i + 1) % polygon.size()]);
    }
  }

  /// Sorted keys of the polygon's sides.
  void sides(std::size_t p, std::vector<std::uint64_t>& keys) const {
    const auto polygon = soup_.polygon(p);
    keys.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto [low, high] = std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]);
      keys.push_back(std::uint64_t{low} << 32 | high);
    }
    std::sort(keys.begin(), keys.end(), interruptible());
  }

  /// Polygons of four and more corners with the same sides. (Triangles are compared after triangulation.)
  void find_duplicates() {
    std::vector<std::pair<std::uint64_t, std::size_t>> hashed;
    std::vector<std::uint64_t> keys;
    for (std::size_t p = 0; p < state_.size(); ++p) {
      if (state_[p] != PolygonState::sound || soup_.polygon(p).size() < 4) continue;
      sides(p, keys);
      std::uint64_t hash = keys.size();
      for (const std::uint64_t key : keys) hash = (hash ^ key) * 0x9E37'79B9'7F4A'7C15u, hash ^= hash >> 29;
      hashed.emplace_back(hash, p);
    }
    std::sort(hashed.begin(), hashed.end(), interruptible());
    for (std::size_t first = 0, last = 0; first < hashed.size(); first = last) {
      while (last < hashed.size() && hashed[last].first == hashed[first].first) ++last;
      if (last - first > 1) find_duplicates(std::span(hashed).subspan(first, last - first));
    }
  }

  /// Among polygons whose sides have the same hash, which need not be the same.
  void find_duplicates(std::span<const std::pair<std::uint64_t, std::size_t>> hashed) {
    std::vector<std::pair<std::vector<std::uint64_t>, std::size_t>> sorted(hashed.size());
    for (std::size_t i = 0; i < hashed.size(); ++i) {
      sorted[i].second = hashed[i].second;
      sides(hashed[i].second, sorted[i].first);
    }
    std::sort(sorted.begin(), sorted.end(), interruptible());
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i].first != sorted[i - 1].first) continue;
      if (twin_of_.empty()) twin_of_.resize(state_.size());
      state_[sorted[i].second] = PolygonState::duplicate;
      twin_of_[sorted[i].second] = sorted[i - 1].second;
    }
  }

  void append(std::size_t p) {
    const auto polygon = soup_.polygon(p);
    auto& triangles = result_.triangles;
    if (!twin_of_.empty()) first_triangle_.push_back(triangles.size());
    switch (state_[p]) {
      case PolygonState::sound:
        triangulator_.triangulate(polygon, p, triangles);
        break;
      case PolygonState::out_of_range:
        for (const Index v : polygon) triangles.push_back({v, kNone, kNone});
        break;
      case PolygonState::degenerate:
        for (const Index v : polygon) triangles.push_back({v, v, v});
        if (polygon.empty() && !soup_.positions.empty()) triangles.push_back({0, 0, 0});
        break;
      case PolygonState::duplicate:
        first_triangle_[p] = first_triangle_[twin_of_[p]];
        triangles.push_back(Triangle(triangles[first_triangle_[p]]));
        break;
      case PolygonState::collapsed:
        break;
    }
    result_.faces.resize(triangles.size(), static_cast<Index>(p));
  }

  PolygonSoup soup_;
  const std::vector<bool>& collapsed_;
  bool repair_;
  const Progress& progress_;
  std::vector<PolygonState> state_;
  // Per polygon, if there are duplicates: an earlier one with the same sides, and its first triangle.
  std::vector<std::size_t> twin_of_;
  std::vector<std::size_t> first_triangle_;
  EdgeSet edges_;
  PolygonTriangulator triangulator_{soup_.positions, edges_, progress_};
  TriangleSoup result_;
};

void check_soup(const PolygonSoup& soup) {
  const auto& offsets = soup.offsets;
  if (offsets.empty() || offsets.front() != 0 || offsets.back() != soup.corners.size() ||
      !std::is_sorted(offsets.begin(), offsets.end()))
    throw InvalidArgument("the offsets of a polygon soup must ascend from 0 to the number of its corners");
  if (soup.positions.size() >= kNone || soup.polygon_count() >= kNone)
    throw BadInput("the mesh is too large: " + std::to_string(soup.positions.size()) + " vertices and " +
                   std::to_string(soup.polygon_count()) + " faces");
}

WeldedSoup welded(PolygonSoup soup, const std::optional<Length>& length, const Progress& progress) {
  if (length) {
    progress.update("finding coincident vertices", 0);
    const double within = length_on(*length, soup);
    if (!std::isfinite(within))
      throw BadInput(
          "the mesh is too large in space: the length within which its vertices are joined overflows");
    return weld(std::move(soup), within, progress);
  }
  WeldedSoup unwelded;
  unwelded.numbering.input_count = soup.positions.size();
  unwelded.soup = std::move(soup);
  return unwelded;
}

/// `second` numbers the vertices that `first` leaves.
VertexNumbering composed(VertexNumbering first, VertexNumbering second) {
  if (first.to_input.empty()) return second;
  if (second.to_input.empty()) return first;
  for (Index& v : second.to_input) v = first.input_vertex(v);
  for (Index& v : first.from_input)
    if (v != kNone) v = second.from_input[v];
  return {first.input_count, std::move(second.to_input), std::move(first.from_input)};
}

ReducedSoup unreduced(PolygonSoup soup) {
  ReducedSoup whole;
  whole.numbering.input_count = soup.positions.size();
  whole.soup = std::move(soup);
  return whole;
}

/// The rim by the vertices that are left by welding.
std::vector<bool> rim_after(std::vector<bool> rim, const VertexNumbering& welded) {
  if (rim.empty() || welded.to_input.empty()) return rim;
  std::vector<bool> joined(welded.to_input.size(), false);
  for (Index v = 0; v < rim.size(); ++v)
    if (rim[v]) joined[welded.mesh_vertex(v)] = true;
  return joined;
}

/// Numbers the faces of triangles as the input does, of which these `polygons` are left; empty if all are.
void number_faces(TriangleSoup& soup, const std::vector<Index>& polygons) {
  if (polygons.empty()) return;
  if (soup.faces.empty())
    soup.faces = polygons;
  else
    for (Index& face : soup.faces) face = polygons[face];
}

bool names_missing_vertices(const TriangleSoup& soup) {
  return std::any_of(soup.triangles.begin(), soup.triangles.end(), [&](const Triangle& t) {
    return *std::max_element(t.begin(), t.end()) >= soup.positions.size();
  });
}

/// "3 faces", "1 face".
std::string counted(std::size_t count, const std::string& thing, const std::string& things) {
  return grouped(count) + " " + (count == 1 ? thing : things);
}

/// What became of the input without repair.
std::vector<std::string> sentences(const RepairCounts& counts, const ReducedSoup& reduced) {
  std::vector<std::string> list;
  if (counts.left_out_vertices > 0)
    list.push_back(
        grouped(counts.left_out_vertices) + " of " +
        counted(reduced.numbering.input_count, "vertex", "vertices") + " and " +
        counted(counts.left_out_faces, "face", "faces") + " were left out" +
        (reduced.stranded_count > 0
             ? ", " + counted(reduced.stranded_count, "vertex", "vertices") + " because no face is left there"
             : "") +
        (counts.split_left_out_rims > 0
             ? "; " + counted(counts.split_left_out_rims, "vertex was", "vertices were") +
                   " split where faces that are left meet in a point alone"
             : ""));
  if (const std::size_t gone = counts.removed_collapsed_faces; gone > 0)
    list.push_back(counted(gone, "face was removed, of which joined vertices leave",
                           "faces were removed, of which joined vertices leave") +
                   " fewer than three corners");
  return list;
}

/// Defects in the input's numbers.
std::vector<Defect> numbered(std::vector<Defect> defects, const VertexNumbering& numbering) {
  for (Defect& d : defects)
    if (names_vertices(d.kind))
      for (Index& v : d.first) v = numbering.input_vertex(v);
  return defects;
}

}  // namespace

void PolygonSoup::add_polygon(std::span<const Index> polygon) {
  corners.insert(corners.end(), polygon.begin(), polygon.end());
  offsets.push_back(corners.size());
}

double PolygonSoup::area(std::size_t p) const {
  const std::span<const Index> ring = polygon(p);
  Point sum = Point::Zero();
  for (std::size_t i = 2; i < ring.size(); ++i)
    sum += (positions[ring[i - 1]] - positions[ring[0]]).cross(positions[ring[i]] - positions[ring[0]]);
  return sum.norm() / 2;
}

BuiltMesh build_mesh(PolygonSoup input, const BuildOptions& options, const Progress& progress,
                     const std::vector<bool>& left_out) {
  progress.update("building the mesh", 0);
  check_soup(input);
  RepairCounts counts;
  ReducedSoup reduced =
      left_out.empty() ? unreduced(std::move(input)) : leave_out(std::move(input), left_out);
  counts.left_out_vertices = reduced.vertex_count;
  counts.left_out_faces = reduced.polygon_count;
  WeldedSoup joined = welded(std::move(reduced.soup), options.weld, progress);
  counts.welded_vertices = joined.joined;
  counts.removed_collapsed_faces = joined.collapsed_count;
  const std::vector<bool> rim = rim_after(std::move(reduced.rim), joined.numbering);
  TriangleSoup soup =
      Triangulation(std::move(joined.soup), joined.collapsed, options.repair, progress).run(counts);
  number_faces(soup, reduced.polygons);
  VertexNumbering numbering = composed(std::move(reduced.numbering), std::move(joined.numbering));
  const bool is_damaged = (options.repair || !rim.empty()) && names_missing_vertices(soup);
  if (!rim.empty() && !is_damaged) numbering = composed(std::move(numbering), split_rims(soup, rim, counts));
  if (options.repair) {
    if (is_damaged)
      throw MeshError(numbered(find_defects(soup.positions, soup.triangles, soup.faces), numbering));
    progress.update("repairing the mesh", 0.2);
    numbering = composed(std::move(numbering), repair_triangles(soup, counts));
  }
  progress.update("building the mesh", 0.5);
  const bool is_renumbered = !soup.faces.empty();
  try {
    // If triangles are not the input's faces, they are needed again to describe an error.
    TriangleMesh mesh = is_renumbered ? TriangleMesh(soup.positions, soup.triangles)
                                      : TriangleMesh(std::move(soup.positions), std::move(soup.triangles));
    return {std::move(mesh), std::move(numbering), counts.listed(), sentences(counts, reduced)};
  } catch (const MeshError& error) {
    std::vector<Defect> defects =
        is_renumbered ? find_defects(soup.positions, soup.triangles, soup.faces) : error.defects();
    throw MeshError(numbered(std::move(defects), numbering), options.repair);
  }
}

}  // namespace morsel::core
