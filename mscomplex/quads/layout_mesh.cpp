#include "morsel/mscomplex/quads/layout_mesh.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

LayoutMesh::LayoutMesh(const core::TriangleMesh& mesh)
    : position_(mesh.positions().begin(), mesh.positions().end()),
      leaving_(mesh.vertex_count()),
      origin_(mesh.halfedge_count()),
      twin_(mesh.twins().begin(), mesh.twins().end()),
      label_(mesh.halfedge_count(), kFree) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) leaving_[v] = mesh.vertex_halfedge(v);
  for (Index h = 0; h < mesh.halfedge_count(); ++h) origin_[h] = mesh.origin(h);
}

Index LayoutMesh::leaving_for(Index from, Index to) const {
  const Index start = leaving_[from];
  Index h = start;
  do {
    if (target(h) == to) return h;
    h = next_around(h);
  } while (h != start);
  return kNone;
}

Index LayoutMesh::leaving_with_label(Index v, Index label) const {
  const Index start = leaving_[v];
  Index h = start;
  do {
    if (label_[h] == label) return h;
    h = next_around(h);
  } while (h != start);
  return kNone;
}

Index LayoutMesh::add_triangle(Index a, Index b, Index c) {
  const Index h = halfedge_count();
  origin_.insert(origin_.end(), {a, b, c});
  twin_.insert(twin_.end(), 3, kNone);
  label_.insert(label_.end(), 3, kFree);
  return h;
}

Index LayoutMesh::split_edge(Index h, double share) {
  const Index g = twin_[h];
  const Index n = next(h);
  const Index q = previous(g);
  const Index a = origin_[h];
  const Index b = origin_[g];
  const Index c = apex(h);
  const Index d = apex(g);
  const Index m = vertex_count();
  position_.push_back(position_[a] + share * (position_[b] - position_[a]));

  const Index h1 = add_triangle(m, b, c);
  const Index n1 = next(h1);
  const Index g1 = add_triangle(b, m, d);
  const Index q1 = previous(g1);
  // The half-edges b → c and d → b have new numbers now.
  pair(n1, twin_[n]);
  pair(q1, twin_[q]);
  label_[n1] = label_[n];
  label_[q1] = label_[q];
  label_[n] = label_[q] = kFree;
  label_[h1] = label_[g1] = label_[h];
  pair(n, previous(h1));
  pair(q, next(g1));
  pair(h1, g1);
  origin_[n] = m;
  origin_[g] = m;
  leaving_.push_back(n);
  leaving_[b] = n1;
  return m;
}

Index LayoutMesh::split_triangle(Index t, const std::array<double, 3>& weights) {
  const Index h = 3 * t;
  const Index a = origin_[h];
  const Index b = origin_[h + 1];
  const Index c = origin_[h + 2];
  const Index m = vertex_count();
  position_.push_back(weights[0] * position_[a] + weights[1] * position_[b] + weights[2] * position_[c]);
  const Index at_bc = add_triangle(b, c, m);
  const Index at_ca = add_triangle(c, a, m);
  pair(at_bc, twin_[h + 1]);
  pair(at_ca, twin_[h + 2]);
  label_[at_bc] = label_[h + 1];
  label_[at_ca] = label_[h + 2];
  label_[h + 1] = label_[h + 2] = kFree;
  origin_[h + 2] = m;
  pair(h + 1, previous(at_bc));        // b → m
  pair(next(at_bc), previous(at_ca));  // c → m
  pair(next(at_ca), h + 2);            // a → m
  leaving_[b] = at_bc;
  leaving_[c] = at_ca;
  leaving_.push_back(h + 2);
  return m;
}

/// Of a vertex and two triangles.
void LayoutMesh::remove_last_split() {
  position_.pop_back();
  leaving_.pop_back();
  for (std::vector<Index>* of_halfedges : {&origin_, &twin_, &label_})
    of_halfedges->resize(of_halfedges->size() - 6);
}

void LayoutMesh::leave_by(Index v, Index h) {
  if (leaving_[v] >= halfedge_count()) leaving_[v] = h;
}

void LayoutMesh::undo_split_edge(Index h) {
  const Index g = twin_[h];
  const Index n = next(h);
  const Index q = previous(g);
  const Index n1 = next(halfedge_count() - 6);
  const Index q1 = previous(halfedge_count() - 3);
  const Index b = origin_[n1];
  pair(n, twin_[n1]);
  pair(q, twin_[q1]);
  label_[n] = label_[n1];
  label_[q] = label_[q1];
  origin_[n] = origin_[g] = b;
  leaving_[b] = g;
  remove_last_split();
  leave_by(origin_[next(n)], next(n));
  leave_by(origin_[q], q);
}

void LayoutMesh::undo_split_triangle(Index t) {
  const Index h = 3 * t;
  const Index at_bc = halfedge_count() - 6;
  const Index at_ca = halfedge_count() - 3;
  pair(h + 1, twin_[at_bc]);
  pair(h + 2, twin_[at_ca]);
  label_[h + 1] = label_[at_bc];
  label_[h + 2] = label_[at_ca];
  origin_[h + 2] = origin_[at_ca];
  leaving_[origin_[h + 1]] = h + 1;
  leaving_[origin_[h + 2]] = h + 2;
  remove_last_split();
  leave_by(origin_[h], h);
}

core::TriangleMesh LayoutMesh::mesh() const {
  std::vector<core::Triangle> triangles(triangle_count());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    triangles[t] = {origin_[3 * t], origin_[3 * t + 1], origin_[3 * t + 2]};
  return {position_, std::move(triangles)};
}

}  // namespace morsel::mscomplex
