#include "morsel/mscomplex/quads/spokes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "morsel/core/parallel/stop.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using Eigen::Vector2d;

namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Edges are crossed away from their ends, to avoid slivers.
constexpr double kLeastShare = 0.05;
/// A new hub is kept away from the sides of its triangle.
constexpr double kLeastWeight = 0.1;

}  // namespace

void SpokeDrawer::put_hub_into_the_middle(const Disc& disc, const std::vector<Vector2d>& place) {
  Index best = kNone;
  std::array<double, 3> weights{};
  double largest_least = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < disc.triangles.size(); ++k) {
    const Vector2d& a = place[disc.corner[3 * k]];
    const Vector2d& b = place[disc.corner[3 * k + 1]];
    const Vector2d& c = place[disc.corner[3 * k + 2]];
    const double area = cross(b - a, c - a);
    if (!(area > 0)) continue;
    const std::array<double, 3> w = {cross(b, c) / area, cross(c, a) / area, cross(a, b) / area};
    const double least = std::min({w[0], w[1], w[2]});
    if (least <= largest_least) continue;
    largest_least = least;
    weights = w;
    best = disc.triangles[k];
  }
  if (best == kNone) throw std::logic_error("quad layout: a disc without area");
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, kLeastWeight);
  for (double& w : weights) w /= sum;

  const Vector2d a = place_[3 * std::size_t{best}];
  const Vector2d b = place_[3 * std::size_t{best} + 1];
  const Vector2d c = place_[3 * std::size_t{best} + 2];
  const Index added = mesh_.halfedge_count();
  hub_ = mesh_.split_triangle(best, weights);
  split_triangle_ = best;
  renumber(3 * best + 1, added);
  renumber(3 * best + 2, added + 3);
  hub_place_ = weights[0] * a + weights[1] * b + weights[2] * c;
  place_[3 * best + 2] = hub_place_;
  place_.insert(place_.end(), {b, c, hub_place_, c, a, hub_place_});
}

/// A border half-edge may get a new number when its triangle is split.
void SpokeDrawer::renumber(Index from, Index to) {
  const auto found = spoke_at_.find(from);
  if (found == spoke_at_.end()) return;
  const std::size_t spoke = found->second;
  spoke_at_.erase(found);
  spoke_at_.emplace(to, spoke);
  start_[spoke] = to;
}

/// Twice the signed area to the left of the line from `from` to the hub.
double SpokeDrawer::offset(Index h, const Vector2d& from) const {
  return cross(hub_place_ - from, place_[h] - from);
}

bool SpokeDrawer::is_left(Index h, const Vector2d& from) const {
  const Index v = mesh_.origin(h);
  if (v < first_new_) return offset(h, from) >= 0;
  return cross(hub_place_ - from, start_of_new_[v - first_new_] - from) >= 0;
}

/// The edge to the hub in the disc's corner between border half-edge `start` and the border before it.
Index SpokeDrawer::edge_to_hub(Index start) const {
  for (Index h = start;; h = mesh_.next_around(h)) {
    if (mesh_.target(h) == hub_) return h;
    if (!mesh_.is_free(LayoutMesh::previous(h))) return kNone;
  }
}

SpokeDrawer::Way SpokeDrawer::straight_way(Index start) const {
  const Vector2d from = place_[start];
  Way way;
  if (way.first = edge_to_hub(start); way.first != kNone) {
    way.found = true;
    return way;
  }
  for (Index h = start;; h = mesh_.next_around(h)) {
    const Index across = LayoutMesh::next(h);
    if (!is_left(across, from) && is_left(LayoutMesh::next(across), from)) {
      way.first = across;
      break;
    }
    if (!mesh_.is_free(LayoutMesh::previous(h))) return way;
  }
  for (Index h = way.first; mesh_.is_free(h);) {
    const double right = std::abs(offset(h, from));
    const double left = std::abs(offset(LayoutMesh::next(h), from));
    const double share = right + left > 0 ? right / (right + left) : 0.5;
    way.shares.push_back(std::clamp(share, kLeastShare, 1 - kLeastShare));
    const Index g = mesh_.twin(h);
    if (mesh_.apex(g) == hub_) {
      way.found = true;
      return way;
    }
    way.keeps_origin.push_back(is_left(LayoutMesh::previous(g), from));
    h = way.keeps_origin.back() ? LayoutMesh::next(g) : LayoutMesh::previous(g);
    if (way.shares.size() > mesh_.triangle_count()) return way;
  }
  return way;
}

SpokeDrawer::Way SpokeDrawer::shortest_way(Index start) const {
  Way way;
  if (way.first = edge_to_hub(start); way.first != kNone) {
    way.found = true;
    return way;
  }
  std::unordered_map<Index, Index> entered;  // triangle → the half-edge on its side by which it was
  std::vector<Index> queue;
  for (Index h = start;; h = mesh_.next_around(h)) {
    entered.emplace(h / 3, kNone);
    queue.push_back(h / 3);
    if (!mesh_.is_free(LayoutMesh::previous(h))) break;
  }
  for (std::size_t k = 0; k < queue.size() && !way.found; ++k)
    for (Index h = 3 * queue[k]; h < 3 * queue[k] + 3; ++h) {
      if (!mesh_.is_free(h)) continue;
      const Index g = mesh_.twin(h);
      if (!entered.emplace(g / 3, g).second) continue;
      queue.push_back(g / 3);
      if (mesh_.apex(g) != hub_) continue;
      std::vector<Index> back;  // half-edges crossed, the last first
      for (Index in = g; in != kNone; in = entered.at(mesh_.twin(in) / 3)) back.push_back(mesh_.twin(in));
      std::reverse(back.begin(), back.end());
      way.found = true;
      way.first = back.front();
      way.shares.assign(back.size(), 0.5);
      for (std::size_t i = 0; i + 1 < back.size(); ++i)
        way.keeps_origin.push_back(back[i + 1] == LayoutMesh::next(mesh_.twin(back[i])));
      break;
    }
  return way;
}

void SpokeDrawer::split(Index h, double share) {
  const Index g = mesh_.twin(h);
  const Vector2d b = place_[LayoutMesh::next(h)];
  const Vector2d c = place_[LayoutMesh::previous(h)];
  const Vector2d d = place_[LayoutMesh::previous(g)];
  const Vector2d m = place_[h] + share * (b - place_[h]);
  const Index added = mesh_.halfedge_count();
  mesh_.split_edge(h, share);
  split_.push_back(h);
  renumber(LayoutMesh::next(h), added + 1);
  renumber(LayoutMesh::previous(g), added + 5);
  place_[LayoutMesh::next(h)] = place_[g] = m;
  place_.insert(place_.end(), {m, b, c, b, m, d});
}

void SpokeDrawer::take(const Way& way, Index arc) {
  Index h = way.first;
  if (way.shares.empty()) {
    mesh_.set_label(h, arc);
    labelled_.push_back(h);
    return;
  }
  for (std::size_t i = 0; i < way.shares.size(); ++i) {
    split(h, way.shares[i]);
    mesh_.set_label(LayoutMesh::next(h), arc);  // from the new vertex back
    if (i + 1 == way.shares.size()) {
      mesh_.set_label(mesh_.back_to_split(h), arc);
    } else {
      h = way.keeps_origin[i] ? mesh_.far_side_at_origin(h) : mesh_.far_side_at_target(h);
    }
  }
}

/// Each edge that is crossed makes two triangles more.
bool SpokeDrawer::fits(const Way& way, std::size_t most_triangles) const {
  return mesh_.triangle_count() + 2 * way.shares.size() <= most_triangles;
}

/// Takes back all that this draw() did to the mesh, the last first.
void SpokeDrawer::undo() {
  for (const Index h : labelled_) mesh_.set_label(h, LayoutMesh::kFree);
  for (; !split_.empty(); split_.pop_back()) mesh_.undo_split_edge(split_.back());
  if (split_triangle_ != kNone) mesh_.undo_split_triangle(split_triangle_);
  place_.resize(mesh_.halfedge_count());
}

SpokeDrawer::Drawn SpokeDrawer::draw(const Disc& disc, const std::vector<Vector2d>& place,
                                     const std::vector<Spoke>& spokes, Index hub,
                                     std::size_t most_triangles) {
  place_.resize(mesh_.halfedge_count(), Vector2d::Zero());
  for (std::size_t k = 0; k < disc.triangles.size(); ++k)
    for (Index i = 0; i < 3; ++i) place_[3 * disc.triangles[k] + i] = place[disc.corner[3 * k + i]];
  spoke_at_.clear();
  start_.clear();
  labelled_.clear();
  split_.clear();
  split_triangle_ = kNone;
  for (const Spoke& spoke : spokes) {
    spoke_at_.emplace(disc.border[spoke.at], start_.size());
    start_.push_back(disc.border[spoke.at]);
  }
  if (hub == kNone) {
    put_hub_into_the_middle(disc, place);
  } else {
    hub_ = hub;
    hub_place_ = place_[mesh_.leaving(hub)];
  }
  first_new_ = mesh_.vertex_count();
  start_of_new_.clear();

  Drawn drawn{hub_, 0};
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    core::throw_if_stopped();
    const Vector2d from = place_[start_[k]];
    Way way = straight_way(start_[k]);
    if (!way.found) {
      ++drawn.missed;
      way = shortest_way(start_[k]);
      if (!way.found) throw std::logic_error("quad layout: no way to the middle of a disc");
    }
    if (!fits(way, most_triangles)) {
      undo();
      return {};
    }
    take(way, spokes[k].arc);
    start_of_new_.resize(mesh_.vertex_count() - first_new_, from);
  }
  return drawn;
}

}  // namespace morsel::mscomplex
