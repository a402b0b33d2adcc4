#include "morsel/core/mesh/mesh_defects.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "morsel/core/mesh/edge_sides.h"
#include "morsel/core/parallel/interruptible.h"
#include "morsel/core/parallel/union_find.h"
#include "morsel/core/text/listed.h"

namespace morsel::core {
namespace {

struct Words {
  std::string_view name;
  std::string_view singular;
  std::string_view plural;
  std::string_view repair;   // what repair does, or empty and
  std::string_view lasting;  // what cannot be repaired
  int width;                 // numbers per element
};

const Words& words(DefectKind kind) {
  static constexpr std::array<Words, 10> kTable = {{
      {"empty", "no triangle", "no triangle", "", "", 1},
      {"non_finite_position", "vertex with a non-finite coordinate", "vertices with a non-finite coordinate",
       "", "non-finite coordinates of vertices in use", 1},
      {"index_out_of_range", "face that names a vertex that does not exist",
       "faces that name a vertex that does not exist", "", "faces that name missing vertices", 1},
      {"degenerate_face", "degenerate face", "degenerate faces",
       "removing degenerate faces and repeated corners", "", 1},
      {"duplicate_face", "duplicate face", "duplicate faces", "removing duplicate faces", "", 1},
      {"unreferenced_vertex", "vertex that no face uses", "vertices that no face uses",
       "removing vertices that no face uses", "", 1},
      {"non_manifold_edge", "non-manifold edge", "non-manifold edges", "splitting non-manifold edges", "", 2},
      {"inconsistent_orientation", "edge between faces of opposite orientation",
       "edges between faces of opposite orientation", "orienting faces consistently", "", 2},
      {"non_orientable", "face of a component that cannot be oriented, as a Möbius band cannot",
       "faces of components that cannot be oriented, as a Möbius band cannot", "",
       "components that cannot be oriented", 1},
      {"non_manifold_vertex", "non-manifold vertex", "non-manifold vertices",
       "splitting non-manifold vertices", "", 1},
  }};
  return kTable[static_cast<std::size_t>(kind)];
}

/// Collects one kind of defect; elements come in ascending order.
class Tally {
 public:
  explicit Tally(DefectKind kind) : defect_{kind, 0, {}} {}
  void add(Index element) {
    if (defect_.count++ < kDefectExamples) defect_.first.push_back(element);
  }
  void add(Index a, Index b) {
    if (defect_.count++ >= kDefectExamples) return;
    defect_.first.push_back(a);
    defect_.first.push_back(b);
  }
  void append_to(std::vector<Defect>& defects) && {
    if (defect_.count > 0) defects.push_back(std::move(defect_));
  }

 private:
  Defect defect_;
};

/// Collects faces, of which several triangles may be parts; triangles come in ascending order.
class FaceTally {
 public:
  FaceTally(DefectKind kind, std::span<const Index> faces) : tally_(kind), faces_(faces) {}
  void add(Index triangle) {
    const Index face = faces_.empty() ? triangle : faces_[triangle];
    if (face != last_) tally_.add(face);
    last_ = face;
  }
  void append_to(std::vector<Defect>& defects) && { std::move(tally_).append_to(defects); }

 private:
  Tally tally_;
  std::span<const Index> faces_;
  Index last_ = kNone;
};

/// Marks the triangles that later checks leave out, and counts them by reason.
std::vector<bool> sound_faces(std::size_t vertices, std::span<const Triangle> triangles,
                              std::span<const Index> faces, std::vector<Defect>& defects) {
  std::vector<bool> sound(triangles.size(), true);
  FaceTally out_of_range(DefectKind::index_out_of_range, faces);
  FaceTally degenerate(DefectKind::degenerate_face, faces);
  FaceTally duplicate(DefectKind::duplicate_face, faces);
  std::vector<std::pair<Triangle, Index>> sorted;
  for (Index t = 0; t < triangles.size(); ++t) {
    Triangle corners = triangles[t];
    std::sort(corners.begin(), corners.end());
    if (corners[2] >= vertices) {
      out_of_range.add(t);
      sound[t] = false;
    } else if (corners[0] == corners[1] || corners[1] == corners[2]) {
      degenerate.add(t);
      sound[t] = false;
    } else {
      sorted.emplace_back(corners, t);
    }
  }
  std::sort(sorted.begin(), sorted.end(), interruptible());
  std::vector<Index> duplicates;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].first == sorted[i - 1].first) duplicates.push_back(sorted[i].second);
  std::sort(duplicates.begin(), duplicates.end());
  for (const Index t : duplicates) {
    duplicate.add(t);
    sound[t] = false;
  }
  std::move(out_of_range).append_to(defects);
  std::move(degenerate).append_to(defects);
  std::move(duplicate).append_to(defects);
  return sound;
}

/// Marks the vertices that faces will use after repair: those of sound and damaged faces, and of degenerate
/// ones that have three different vertices when repeated corners are merged. Returns whether there is any.
bool mark_used(std::span<const Triangle> triangles, std::span<const Index> faces,
               const std::vector<bool>& sound, std::vector<bool>& used) {
  bool any = false;
  const auto mark = [&](const Triangle& t) {
    any = true;
    for (const Index v : t)
      if (v < used.size()) used[v] = true;
  };
  std::vector<Index> corners;
  for (std::size_t first = 0, last = 0; first < triangles.size(); first = last) {
    last = first + 1;
    while (!faces.empty() && last < triangles.size() && faces[last] == faces[first]) ++last;
    bool is_degenerate = false;
    for (std::size_t t = first; t < last; ++t) {
      const auto& [a, b, c] = triangles[t];
      const bool is_damaged = std::max({a, b, c}) >= used.size();
      if (sound[t] || is_damaged)
        mark(triangles[t]);
      else
        is_degenerate = is_degenerate || a == b || b == c || c == a;
    }
    if (!is_degenerate || last - first < 2) continue;
    corners.clear();
    for (std::size_t t = first; t < last; ++t)
      corners.insert(corners.end(), triangles[t].begin(), triangles[t].end());
    std::sort(corners.begin(), corners.end(), interruptible());
    if (std::unique(corners.begin(), corners.end()) - corners.begin() < 3) continue;
    for (std::size_t t = first; t < last; ++t) mark(triangles[t]);
  }
  return any;
}

/// Edges, and what is wrong with them; `joins` gets the pairs of half-edges of edges with two faces.
void check_edges(std::span<const Triangle> triangles, std::span<const Index> faces,
                 const std::vector<bool>& sound, std::vector<std::pair<Index, Index>>& joins,
                 std::vector<Defect>& defects) {
  std::vector<EdgeSide> halfedges;
  for (Index t = 0; t < triangles.size(); ++t)
    for (Index i = 0; sound[t] && i < 3; ++i)
      halfedges.push_back(edge_side(triangles[t][i], triangles[t][(i + 1) % 3], 3 * t + i));
  std::sort(halfedges.begin(), halfedges.end(), interruptible());
  Tally non_manifold(DefectKind::non_manifold_edge);
  std::vector<std::pair<EdgeSide, Index>> turned;  // edges of faces that run the same way, and one of these
  const auto origin = [&](Index h) { return triangles[h / 3][h % 3]; };
  // Parity union-find over the faces: a contradiction marks its component as non-orientable.
  UnionFind components(static_cast<Index>(triangles.size()));
  ParityUnionFind orientation(static_cast<Index>(triangles.size()));
  std::vector<Index> contradictions;
  for_each_edge(halfedges, [&](std::size_t first, std::size_t last) {
    const EdgeSide& side = halfedges[first];
    if (last - first > 2) non_manifold.add(side.smaller, side.larger);
    if (last - first != 2) return;
    const Index a = side.halfedge;
    const Index b = halfedges[first + 1].halfedge;
    joins.emplace_back(a, b);
    const bool same_way = origin(a) == origin(b);
    if (same_way) turned.emplace_back(side, a / 3);
    components.unite(a / 3, b / 3);
    if (!orientation.unite(a / 3, b / 3, same_way)) contradictions.push_back(a / 3);
  });
  std::vector<bool> bad(triangles.size(), false);
  for (const Index t : contradictions) bad[components.find(t)] = true;
  Tally inconsistent(DefectKind::inconsistent_orientation);
  for (const auto& [side, face] : turned)
    if (!bad[components.find(face)]) inconsistent.add(side.smaller, side.larger);
  FaceTally non_orientable(DefectKind::non_orientable, faces);
  for (Index t = 0; !contradictions.empty() && t < triangles.size(); ++t)
    if (sound[t] && bad[components.find(t)]) non_orientable.add(t);
  std::move(non_manifold).append_to(defects);
  std::move(inconsistent).append_to(defects);
  std::move(non_orientable).append_to(defects);
}

/// Vertices whose corners, joined across edges of two faces, form more than one fan.
void check_fans(std::size_t vertices, std::span<const Triangle> triangles, const std::vector<bool>& sound,
                const std::vector<std::pair<Index, Index>>& joins, std::vector<Defect>& defects) {
  UnionFind fans(static_cast<Index>(3 * triangles.size()));
  const auto next = [](Index h) { return h % 3 == 2 ? h - 2 : h + 1; };
  for (const auto& [a, b] : joins) {
    throw_if_stopped_at_times();
    const bool same_way = triangles[a / 3][a % 3] == triangles[b / 3][b % 3];
    fans.unite(a, same_way ? b : next(b));
    fans.unite(next(a), same_way ? next(b) : b);
  }
  std::vector<Index> fans_of(vertices, 0);
  for (Index t = 0; t < triangles.size(); ++t)
    for (Index i = 0; sound[t] && i < 3; ++i)
      if (fans.find(3 * t + i) == 3 * t + i) ++fans_of[triangles[t][i]];
  Tally non_manifold(DefectKind::non_manifold_vertex);
  for (Index v = 0; v < vertices; ++v)
    if (fans_of[v] > 1) non_manifold.add(v);
  std::move(non_manifold).append_to(defects);
}

}  // namespace

std::string_view defect_name(DefectKind kind) { return words(kind).name; }

std::string_view repair_of(DefectKind kind) { return words(kind).repair; }

bool names_vertices(DefectKind kind) {
  switch (kind) {
    case DefectKind::non_finite_position:
    case DefectKind::unreferenced_vertex:
    case DefectKind::non_manifold_edge:
    case DefectKind::inconsistent_orientation:
    case DefectKind::non_manifold_vertex:
      return true;
    default:
      return false;
  }
}

std::string describe(const Defect& defect) {
  const Words& w = words(defect.kind);
  if (defect.kind == DefectKind::empty) return std::string(w.singular);
  std::string text =
      std::to_string(defect.count) + " " + std::string(defect.count == 1 ? w.singular : w.plural);
  const auto width = static_cast<std::size_t>(w.width);
  const std::size_t shown = defect.first.size() / width;
  text += shown < defect.count ? " (the first: " : " (";
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += ", ";
    text += std::to_string(defect.first[i * width]);
    if (width == 2) text += "-" + std::to_string(defect.first[i * width + 1]);
  }
  return text + ")";
}

std::vector<Defect> find_defects(std::span<const Point> positions, std::span<const Triangle> triangles,
                                 std::span<const Index> faces) {
  std::vector<Defect> of_faces;
  const std::vector<bool> sound = sound_faces(positions.size(), triangles, faces, of_faces);
  std::vector<bool> used(positions.size(), false);
  std::vector<Defect> defects;
  if (!mark_used(triangles, faces, sound, used)) defects.push_back({DefectKind::empty, 1, {}});
  Tally non_finite(DefectKind::non_finite_position);
  for (Index v = 0; v < positions.size(); ++v)
    if (used[v] && !positions[v].allFinite()) non_finite.add(v);
  std::move(non_finite).append_to(defects);
  std::move(of_faces.begin(), of_faces.end(), std::back_inserter(defects));

  Tally unreferenced(DefectKind::unreferenced_vertex);
  for (const Triangle& t : triangles)
    for (const Index v : t)
      if (v < positions.size()) used[v] = true;
  for (Index v = 0; v < positions.size(); ++v)
    if (!used[v]) unreferenced.add(v);
  std::move(unreferenced).append_to(defects);

  std::vector<std::pair<Index, Index>> joins;
  check_edges(triangles, faces, sound, joins, defects);
  check_fans(positions.size(), triangles, sound, joins, defects);
  return defects;
}

namespace {

std::string sentence(const std::vector<Defect>& defects, bool repair_tried, std::string_view subject) {
  const auto has = [&](DefectKind kind) {
    return std::any_of(defects.begin(), defects.end(), [&](const Defect& d) { return d.kind == kind; });
  };
  std::vector<std::string> found;
  std::vector<std::string> fixes;
  std::vector<std::string> lasting;
  for (const Defect& d : defects) {
    found.push_back(describe(d));
    if (!words(d.kind).lasting.empty()) lasting.emplace_back(words(d.kind).lasting);
    if (!repair_of(d.kind).empty()) fixes.emplace_back(repair_of(d.kind));
  }
  std::string text = std::string(subject) + " cannot be used: " + (repair_tried ? "after repair it " : "it ");
  text += repair_tried && !has(DefectKind::empty) ? "still has " : "has ";
  text += listed(found, " and ");
  if (repair_tried || has(DefectKind::empty)) return text;
  if (lasting.empty()) return text + "; repair (--repair) would fix this by " + listed(fixes, " and ");
  return text + "; repair cannot fix " + listed(lasting, " and ");
}

}  // namespace

MeshError::MeshError(std::vector<Defect> defects, bool repair_tried, std::string_view subject)
    : BadInput(sentence(defects, repair_tried, subject)),
      defects_(std::move(defects)),
      repair_tried_(repair_tried) {}

}  // namespace morsel::core
