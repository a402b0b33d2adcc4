#include "support/complex_oracle.h"

#include <algorithm>
#include <set>

namespace morsel::test {
namespace {

using core::Index;
using core::kNone;

Index other(const Cell& edge, Index v) { return edge[0] == v ? edge[1] : edge[0]; }

}  // namespace

ComplexOracle::ComplexOracle(const core::ScalarField& field)
    : field_(field), gradient_(process_lower_stars(field)) {
  for (const auto& [facet, cell] : gradient_.pairs) facet_[cell] = facet;
  for (const Cell& cell : gradient_.critical) critical_[cell] = true;
  for (const auto& t : field.mesh().triangles()) {
    const Cell triangle = sorted_cell({t[0], t[1], t[2]});
    corners_[triangle] = t;
    for (int i = 0; i < 3; ++i) cofaces_[sorted_cell({t[i], t[(i + 1) % 3]})].push_back(triangle);
  }
}

std::vector<Index> ComplexOracle::way_down(Index vertex) const {
  std::vector<Index> way = {vertex};
  for (auto pair = gradient_.pairs.find({vertex}); pair != gradient_.pairs.end();
       pair = gradient_.pairs.find({way.back()}))
    way.push_back(other(pair->second, way.back()));
  return way;
}

std::vector<Cell> ComplexOracle::way_up(const Cell& triangle) const {
  std::vector<Cell> way = {triangle};
  while (!critical_.contains(way.back())) {
    const auto& both = cofaces_.at(facet_.at(way.back()));
    if (both.size() == 1) break;
    way.push_back(both[0] == way.back() ? both[1] : both[0]);
  }
  return way;
}

Cell ComplexOracle::top(const Cell& triangle) const {
  const Cell last = way_up(triangle).back();
  return critical_.contains(last) ? last : cap_at(facet_.at(last));
}

Cell ComplexOracle::cap_at(const Cell& edge) const {
  const auto& mesh = field_.mesh();
  return {mesh.origin(mesh.boundary_loop(mesh.boundary_loop_of_vertex(edge[0])).front())};
}

Cell ComplexOracle::top_of_vertex(Index vertex) const {
  std::vector<Index> best_ranks;
  Cell best;
  for (const auto& [triangle, corners] : corners_) {
    if (std::find(triangle.begin(), triangle.end(), vertex) == triangle.end()) continue;
    std::vector<Index> ranks = {field_.rank(triangle[0]), field_.rank(triangle[1]), field_.rank(triangle[2])};
    std::sort(ranks.rbegin(), ranks.rend());
    if (ranks > best_ranks) {
      best_ranks = ranks;
      best = triangle;
    }
  }
  return top(best);
}

Index ComplexOracle::minimum_of_triangle(const Cell& triangle) const {
  return way_down(*std::min_element(triangle.begin(), triangle.end(),
                                    [&](Index a, Index b) { return field_.is_lower(a, b); }))
      .back();
}

void ComplexOracle::collect_at_vertex(Index vertex, Index from, std::vector<ArcName>& arcs) const {
  std::vector<Index> ring;
  field_.mesh().neighbors(vertex, ring);
  if (from != kNone) {  // begin behind the edge that leads down
    std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), from), ring.end());
    ring.erase(ring.begin());
  }
  for (const Index u : ring) {
    const Cell edge = sorted_cell({vertex, u});
    if (critical_.contains(edge)) arcs.push_back({edge, Cell{vertex}});
    const auto pair = gradient_.pairs.find({u});
    if (pair != gradient_.pairs.end() && pair->second == edge) collect_at_vertex(u, vertex, arcs);
  }
}

/// From triangle `here` across its side a → b.
void ComplexOracle::collect_across(Index a, Index b, const Cell& here, std::vector<ArcName>& arcs) const {
  const Cell edge = sorted_cell({a, b});
  if (critical_.contains(edge)) {
    arcs.push_back({edge, here});
    return;
  }
  const auto& triangles = cofaces_.at(edge);
  const auto there =
      std::find_if(triangles.begin(), triangles.end(), [&](const Cell& t) { return t != here; });
  if (there == triangles.end()) return;
  const auto facet = facet_.find(*there);
  if (facet == facet_.end() || facet->second != edge) return;
  core::Triangle corners = corners_.at(*there);  // it runs along the edge as b → a
  while (corners[0] != b) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  collect_across(corners[1], corners[2], *there, arcs);
  collect_across(corners[2], corners[0], *there, arcs);
}

std::vector<ComplexOracle::ArcName> ComplexOracle::around_minimum(Index vertex) const {
  std::vector<ArcName> arcs;
  collect_at_vertex(vertex, kNone, arcs);
  return arcs;
}

std::vector<ComplexOracle::ArcName> ComplexOracle::around_maximum(Index triangle) const {
  const auto& t = field_.mesh().triangle(triangle);
  std::vector<ArcName> arcs;
  for (int i = 0; i < 3; ++i) collect_across(t[i], t[(i + 1) % 3], sorted_cell({t[0], t[1], t[2]}), arcs);
  return arcs;
}

std::vector<ComplexOracle::ArcName> ComplexOracle::around_cap(Index loop) const {
  const auto& mesh = field_.mesh();
  std::vector<Index> vertices;
  for (const Index h : mesh.boundary_loop(loop)) vertices.push_back(mesh.origin(h));
  std::vector<ArcName> arcs;
  const Cell cap = {vertices.front()};
  for (std::size_t i = vertices.size(); i-- > 0;)
    collect_across(vertices[(i + 1) % vertices.size()], vertices[i], cap, arcs);
  return arcs;
}

}  // namespace morsel::test
