#include "morsel/mscomplex/quads/arc_drawing.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/mscomplex/quads/disc_embedding.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

namespace {

/// None: arcs follow angles better where the stretch is not reduced.
constexpr int kStretchRounds = 0;

/// Of the first drawing: so many times the surface's own triangles, or this number.
constexpr std::size_t kMostTimes = 16;
constexpr std::size_t kMostTriangles = 1 << 22;
/// How many triangles a relaxation may add if that is more than there are, and, to a star, more than twice
/// those of its disc. Where k arcs meet, k² edges or more are left from drawing them, and the next arcs cross
/// them all.
constexpr std::size_t kMostAdded = 1 << 16;
constexpr std::size_t kMostAddedToStar = 1 << 13;

}  // namespace

ArcDrawing::ArcDrawing(const MorseSmaleComplex& complex) : ArcDrawing(complex, cap(complex.mesh())) {}

ArcDrawing::ArcDrawing(const MorseSmaleComplex& complex, const CappedSurface& capped)
    : complex_(complex),
      mesh_(capped.mesh),
      finder_(mesh_),
      drawer_(mesh_),
      node_vertex_(complex.node_count(), kNone) {
  for (Index n = 0; n < complex.node_count(); ++n)
    if (complex.kind(n) != NodeKind::saddle) node_vertex_[n] = complex.node(n).vertex;
  for (Index k = 0; k < complex.cap_count(); ++k) node_vertex_[complex.cap_node(k)] = capped.cap_vertex[k];
}

std::string ArcDrawing::name(Index node) const {
  const Node n = complex_.node(node);
  const char* kind = n.kind == NodeKind::minimum   ? "minimum"
                     : n.kind == NodeKind::saddle  ? "saddle"
                     : n.kind == NodeKind::maximum ? "maximum"
                                                   : "boundary loop";
  return std::string(kind) + " at vertex " + std::to_string(n.vertex);
}

std::size_t ArcDrawing::most_at_first(std::size_t triangles) {
  return std::max(kMostTimes * triangles, kMostTriangles);
}

void ArcDrawing::draw_first(std::size_t most) {
  most_triangles_ = most;
  cut_along_descents();
  put_saddles_on_edges();
  node_at_.assign(mesh_.vertex_count(), kNone);
  for (Index n = 0; n < complex_.node_count(); ++n) node_at_[node_vertex_[n]] = n;

  std::vector<Index> extrema;
  for (Index i = 0; i < complex_.maximum_count(); ++i) extrema.push_back(complex_.maximum_node(i));
  for (Index k = 0; k < complex_.cap_count(); ++k) extrema.push_back(complex_.cap_node(k));
  draw_stars(extrema);
  for (Index h = 0; h < mesh_.halfedge_count(); ++h)
    if (const Index label = mesh_.label(h);
        label == LayoutMesh::kCut ||
        (label != LayoutMesh::kFree && MorseSmaleComplex::arc_kind(label) == ArcKind::descending))
      mesh_.set_label(h, LayoutMesh::kFree);
  mark_rims();
  extrema.clear();
  for (Index i = 0; i < complex_.minimum_count(); ++i) extrema.push_back(i);
  draw_stars(extrema);
}

/// From here on the caps' fans are excluded: rays to their middles have crossed the rims, each once.
void ArcDrawing::mark_rims() {
  on_rim_.assign(complex_.cap_count() > 0 ? mesh_.vertex_count() : 0, false);
  for (Index k = 0; k < complex_.cap_count(); ++k) {
    const Index start = mesh_.leaving(node_vertex_[complex_.cap_node(k)]);
    Index h = start;
    do {
      mesh_.set_label(LayoutMesh::next(h), LayoutMesh::kRim);
      on_rim_[mesh_.target(h)] = true;
      h = mesh_.next_around(h);
    } while (h != start);
  }
}

/// Marks the edges of the V-paths from both ends of all critical edges: cut along these and the critical
/// edges, the surface falls into one disc for each maximum.
void ArcDrawing::cut_along_descents() {
  const core::TriangleMesh& mesh = complex_.mesh();
  const DiscreteGradient& gradient = complex_.gradient();
  std::vector<bool> done(mesh.vertex_count(), false);
  for (const CriticalCell& saddle : gradient.saddles())
    for (Index v : mesh.edge_vertices(saddle.cell))
      for (Index down; !done[v] && (down = gradient.descend(v)) != kNone; v = down) {
        done[v] = true;
        mesh_.set_label(mesh_.leaving_for(v, down), LayoutMesh::kCut);
      }
}

void ArcDrawing::put_saddles_on_edges() {
  const core::TriangleMesh& mesh = complex_.mesh();
  for (Index i = 0; i < complex_.saddle_count(); ++i) {
    const Index edge_halfedge = mesh.edge_halfedge(complex_.gradient().saddles()[i].cell);
    const Index a = mesh.origin(edge_halfedge);
    const Index b = mesh.target(edge_halfedge);
    const Index h = mesh_.leaving_for(a, b);  // earlier splits may have given it another number
    node_vertex_[complex_.saddle_node(i)] = mesh_.split_edge(h, 0.5);
    mesh_.set_label(h, 4 * i);
    mesh_.set_label(LayoutMesh::next(mesh_.far_side_at_target(h)), 4 * i + 2);
  }
}

/// The disc of a minimum or maximum, and the saddles of the arcs that end there: its border passes these
/// saddles, in the cyclic order of the arcs. At a saddle, the arc into the disc comes counter-clockwise
/// after the one along which the border continues.
ArcDrawing::Star ArcDrawing::find_star(Index extremum, Index some_border) {
  Star star;
  star.node = extremum;
  star.disc = finder_.find(some_border, name(extremum));
  for (Index i = 0; i < star.disc.border_size(); ++i) {
    const Index node = node_at(star.disc.vertex[i]);
    if (node == kNone || complex_.kind(node) != NodeKind::saddle) continue;
    const Index onward = mesh_.label(star.disc.border[i]);
    if (onward >= complex_.arc_count() || complex_.arc_saddle(onward) != node)
      throw std::logic_error("quad layout: the border around the " + name(extremum) + " is out of order");
    star.spokes.push_back({i, complex_.next_around_saddle(onward)});
  }
  const auto arcs = complex_.arcs_ending_at(extremum);
  bool in_order = star.spokes.size() == arcs.size();
  for (std::size_t k = 0; in_order && k < arcs.size(); ++k)
    in_order = complex_.arc_end(star.spokes[k].arc) == extremum &&
               complex_.next_around_end(star.spokes[k].arc) == star.spokes[(k + 1) % arcs.size()].arc;
  if (!in_order)
    throw std::logic_error("quad layout: the arcs around the " + name(extremum) + " are out of order");
  return star;
}

void ArcDrawing::embed(Star& star) const {
  std::vector<Index> at;
  for (const Spoke& spoke : star.spokes) at.push_back(spoke.at);
  star.place = border_on_circle(mesh_, star.disc, at);
  embed_inside(mesh_, star.disc, kStretchRounds, star.place, "the " + name(star.node));
}

void ArcDrawing::draw(const Star& star) {
  const auto drawn =
      drawer_.draw(star.disc, star.place, star.spokes, node_vertex_[star.node], most_triangles_);
  if (drawn.hub == kNone)
    throw core::BadInput("the " + std::to_string(star.spokes.size()) + " arcs that meet in the " +
                         name(star.node) + " would cut the surface of " +
                         std::to_string(complex_.mesh().triangle_count()) + " triangles into more than " +
                         std::to_string(most_triangles_) +
                         "; a field with fewer critical points there, smoothed or simplified by "
                         "persistence, would help");
  missed_ += drawn.missed;
}

/// Moves the star's node to the middle of its disc, unless its arcs would take too many triangles.
void ArcDrawing::draw_again(const Star& star) {
  const std::size_t most =
      mesh_.triangle_count() + std::max(2 * star.disc.triangles.size(), kMostAddedToStar);
  const auto drawn = drawer_.draw(star.disc, star.place, star.spokes, kNone, std::min(most, most_triangles_));
  if (drawn.hub == kNone) {
    for (const auto& [h, arc] : star.erased) mesh_.set_label(h, arc);
    ++left_;
    return;
  }
  missed_ += drawn.missed;
  node_at_[node_vertex_[star.node]] = kNone;
  node_vertex_[star.node] = drawn.hub;
  node_at_.resize(mesh_.vertex_count(), kNone);
  node_at_[drawn.hub] = star.node;
}

/// Discs of different extrema of a kind have no triangle in common, and drawing splits only edges inside.
void ArcDrawing::draw_stars(const std::vector<Index>& extrema) {
  std::vector<Star> stars = find_stars(extrema);
  embed_all(stars);
  for (const Star& star : stars) draw(star);
}

std::vector<ArcDrawing::Star> ArcDrawing::find_stars(const std::vector<Index>& extrema) {
  std::vector<Star> stars;
  for (const Index node : extrema) {
    const Index border = finder_.find_border(mesh_.leaving(node_vertex_[node]) / 3);
    if (border == kNone) throw std::logic_error("quad layout: no saddle near the " + name(node));
    stars.push_back(find_star(node, border));
  }
  return stars;
}

void ArcDrawing::embed_all(std::vector<Star>& stars) const {
  core::parallel_for(0, stars.size(), 1, [&](std::size_t i, std::size_t) { embed(stars[i]); });
}

Index ArcDrawing::start_of(Index arc) const {
  return mesh_.leaving_with_label(node_vertex_[complex_.arc_saddle(arc)], arc);
}

/// The next half-edge along the arc that h is on; kNone at its end and at a rim.
Index ArcDrawing::next_of_arc(Index h) const {
  if (node_at(mesh_.target(h)) != kNone || is_on_rim(mesh_.target(h))) return kNone;
  const Index back = mesh_.twin(h);
  Index on = mesh_.next_around(back);
  while (mesh_.label(on) != mesh_.label(h)) on = mesh_.next_around(on);
  return on;
}

void ArcDrawing::follow(Index arc, std::vector<Index>& vertices) const {
  Index h = start_of(arc);
  vertices.assign(1, mesh_.origin(h));
  for (; h != kNone; h = next_of_arc(h)) vertices.push_back(mesh_.target(h));
}

void ArcDrawing::erase(Index arc, std::vector<Erased>& erased) {
  for (Index h = start_of(arc); h != kNone;) {
    const Index next = next_of_arc(h);
    mesh_.set_label(h, LayoutMesh::kFree);
    erased.push_back({h, arc});
    h = next;
  }
}

void ArcDrawing::redraw(Index extremum_begin, Index extremum_end) {
  std::vector<Index> extrema;
  std::vector<std::vector<Erased>> erased(extremum_end - extremum_begin);
  for (Index node = extremum_begin; node < extremum_end; ++node) {
    extrema.push_back(node);
    for (const Index arc : complex_.arcs_ending_at(node)) erase(arc, erased[node - extremum_begin]);
  }
  std::vector<Star> stars = find_stars(extrema);
  for (std::size_t i = 0; i < stars.size(); ++i) stars[i].erased = std::move(erased[i]);
  embed_all(stars);
  for (const Star& star : stars) draw_again(star);
}

/// The four quads around a saddle form a disc with eight corners, of which every other one, from that at the
/// end of its first arc on, is joined to it. Where they are not four different quads the saddle is not moved.
void ArcDrawing::redraw_saddle(Index saddle) {
  const Index first = 4 * (saddle - complex_.minimum_count());
  std::array<Index, 4> around{};
  for (Index k = 0; k < 4; ++k) around[k] = complex_.quad_left_of(first + k);
  std::sort(around.begin(), around.end());
  if (std::adjacent_find(around.begin(), around.end()) != around.end()) return;

  // The border continues from the end of the first arc, keeping the patch on the left of the arc on its left.
  Index border = start_of(first);
  do {
    border = LayoutMesh::next(border);
    while (mesh_.is_free(border)) border = LayoutMesh::next(mesh_.twin(border));
  } while (node_at(mesh_.origin(border)) == kNone);
  Star star;
  std::array<Index, 4> end{};
  std::vector<Index> arc;
  for (Index k = 0; k < 4; ++k) {
    follow(first + k, arc);
    end[k] = arc.back();
    erase(first + k, star.erased);
  }
  const auto is_corner = [&](Index v) {  // a node, or where an arc ended at a rim
    return node_at(v) != kNone || (is_on_rim(v) && (v == end[1] || v == end[3]));
  };
  star.node = saddle;
  star.disc = finder_.find(border, name(saddle));
  Index corners = 0;
  for (Index i = 0; i < star.disc.border_size(); ++i)
    if (is_corner(star.disc.vertex[i]) && corners++ % 2 == 0) star.spokes.push_back({i, first + corners / 2});
  if (corners != 8)
    throw std::logic_error("quad layout: the patches around the " + name(saddle) + " are out of order");
  embed(star);
  draw_again(star);
}

void ArcDrawing::relax(const core::Progress& progress) {
  most_triangles_ = mesh_.triangle_count() + std::max<std::size_t>(mesh_.triangle_count(), kMostAdded);
  redraw(complex_.maximum_node(0), complex_.maximum_node(complex_.maximum_count()));
  progress.throw_if_cancelled();
  redraw(0, complex_.minimum_count());
  for (Index i = 0; i < complex_.saddle_count(); ++i) {
    if (i % 16 == 0) progress.throw_if_cancelled();
    redraw_saddle(complex_.saddle_node(i));
  }
}

}  // namespace morsel::mscomplex
