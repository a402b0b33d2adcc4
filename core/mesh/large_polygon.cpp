#include "morsel/core/mesh/large_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

#include "morsel/core/mesh/corner_tree.h"
#include "morsel/core/parallel/index_set.h"

namespace morsel::core {
namespace {

class EarClipping {
 public:
  EarClipping(const PlacedPolygon& polygon, EdgeSet& edges, std::uint64_t& tests_left,
              const Progress& progress)
      : polygon_(polygon),
        edges_(edges),
        tests_left_(tests_left),
        progress_(progress),
        size_(polygon.vertices.size()),
        previous_(size_),
        next_(size_),
        ears_(size_) {
    for (std::size_t i = 0; i < size_; ++i) {
      previous_[i] = i == 0 ? size_ - 1 : i - 1;
      next_[i] = i + 1 == size_ ? 0 : i + 1;
    }
  }

  bool run(std::vector<Triangle>& triangles) {
    plant_tree();
    look_for_ears();
    std::size_t start = 0;
    for (left_ = size_; left_ > 3; --left_) {
      if (tests_left_ == 0) return false;
      if (left_ % kPause == 0) progress_.throw_if_cancelled();
      const std::size_t b = corner_to_cut(start);
      const std::size_t a = previous_[b];
      const std::size_t c = next_[b];
      triangles.push_back({vertex(a), vertex(b), vertex(c)});
      if (vertex(a) != vertex(c)) edges_.insert(vertex(a), vertex(c));
      next_[a] = c;
      previous_[c] = a;
      previous_[b] = b;  // removed
      ears_.erase(b);
      reflex_->remove(b);
      for (const std::size_t end : {a, c})
        if (!is_reflex(end)) reflex_->remove(end);
      for (const std::size_t end : {a, c}) renew(end);
      start = next_[c];
    }
    triangles.push_back({vertex(start), vertex(next_[start]), vertex(previous_[start])});
    return true;
  }

 private:
  static constexpr std::size_t kPause = 1024;  // corners between two checks for a stop
  static constexpr int kSearches = 16;

  /// A candidate for cutting off if there is no ear; the greatest is the best.
  struct Candidate {
    enum Rank { degenerate, taken, free };
    Rank rank;
    long shape;         // in steps: rounding must not decide between equals
    std::size_t place;  // in the order in which candidates were found: earlier ones first
    std::size_t corner, previous, next;
    bool operator<(const Candidate& o) const {
      return std::tuple(rank, shape, o.place) < std::tuple(o.rank, o.shape, place);
    }
  };

  Index vertex(std::size_t i) const { return polygon_.vertices[i]; }
  bool is_gone(std::size_t i) const { return previous_[i] == i; }
  double shape(std::size_t i) const { return polygon_.shape(previous_[i], i, next_[i]); }
  bool is_reflex(std::size_t i) const { return !(shape(i) > 0); }

  Candidate::Rank rank(std::size_t i) const {
    const Index a = vertex(previous_[i]);
    const Index b = vertex(i);
    const Index c = vertex(next_[i]);
    if (a == c || a == b || b == c) return Candidate::degenerate;
    return edges_.contains(a, c) ? Candidate::taken : Candidate::free;
  }

  void plant_tree() {
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < size_; ++i)
      if (is_reflex(i)) corners.push_back(i);
    if (polygon_.normal.norm() < 0.5) corners.clear();  // without area no corner lies in an ear
    reflex_.emplace(polygon_.positions, polygon_.normal, corners);
  }

  bool is_ear(std::size_t i) {
    if (rank(i) != Candidate::free || is_reflex(i)) return false;
    std::uint64_t tests = 1;
    const bool is_empty = !reflex_->any_in(previous_[i], i, next_[i], tests);
    tests_left_ -= std::min(tests_left_, tests);
    return is_empty;
  }

  /// Tests all corners that are not known to be ears.
  void look_for_ears() {
    for (std::size_t i = 0; i < size_ && tests_left_ > 0; ++i) {
      if (i % kPause == 0) progress_.throw_if_cancelled();
      if (!is_gone(i) && !ears_.contains(i) && is_ear(i)) ears_.insert(i);
    }
    ++searches_;
    cut_since_search_ = 0;
  }

  /// After a change at corner i.
  void renew(std::size_t i) {
    if (is_ear(i))
      ears_.insert(i);
    else
      ears_.erase(i);
    if (has_candidates_) add_candidate(i);
  }

  std::size_t corner_to_cut(std::size_t start) {
    if (const std::size_t ear = next_ear(start); ear != IndexSet::kNone) return ear;
    // A corner with unchanged neighbours becomes an ear only by rounding or crossing sides. All searches
    // together test each corner some tens of times.
    if (searches_ < kSearches || cut_since_search_ > left_ / 8) {
      look_for_ears();
      if (const std::size_t ear = next_ear(start); ear != IndexSet::kNone) return ear;
    }
    ++cut_since_search_;
    return best_candidate();
  }

  /// The first ear from `start` on.
  std::size_t next_ear(std::size_t start) {
    for (;;) {
      std::size_t ear = ears_.next(start);
      if (ear == IndexSet::kNone) ear = ears_.next(0);
      // Another corner may have been cut off by the same edge, where the polygon passes through a vertex more
      // than once.
      if (ear == IndexSet::kNone || rank(ear) == Candidate::free) return ear;
      ears_.erase(ear);
    }
  }

  void add_candidate(std::size_t i) {
    candidates_.push({rank(i), std::lround(shape(i) * 1e9), places_++, i, previous_[i], next_[i]});
  }

  std::size_t best_candidate() {
    if (!has_candidates_) {
      has_candidates_ = true;
      for (std::size_t i = 0; i < size_; ++i)
        if (!is_gone(i)) add_candidate(i);
    }
    for (;;) {
      const Candidate best = candidates_.top();
      candidates_.pop();
      const std::size_t i = best.corner;
      if (is_gone(i) || previous_[i] != best.previous || next_[i] != best.next) continue;
      if (rank(i) == best.rank) return i;
      add_candidate(i);
    }
  }

  const PlacedPolygon& polygon_;
  EdgeSet& edges_;
  std::uint64_t& tests_left_;
  const Progress& progress_;
  std::size_t size_;
  std::size_t left_ = 0;                      // corners not cut off yet
  std::vector<std::size_t> previous_, next_;  // their ring
  std::optional<CornerTree> reflex_;
  IndexSet ears_;
  int searches_ = 0;
  std::size_t cut_since_search_ = 0;
  std::priority_queue<Candidate> candidates_;
  bool has_candidates_ = false;
  std::size_t places_ = 0;
};

}  // namespace

double PlacedPolygon::shape(std::size_t a, std::size_t b, std::size_t c) const {
  const Point ab = positions[b] - positions[a];
  const Point bc = positions[c] - positions[b];
  const Point ca = positions[a] - positions[c];
  const double edges = ab.squaredNorm() + bc.squaredNorm() + ca.squaredNorm();
  const double result = 2 * std::sqrt(3.0) * normal.dot(ab.cross(bc)) / edges;
  return std::isfinite(result) ? result : 0;
}

bool cut_large_polygon(const PlacedPolygon& polygon, EdgeSet& edges, std::uint64_t& tests_left,
                       std::vector<Triangle>& triangles, const Progress& progress) {
  return EarClipping(polygon, edges, tests_left, progress).run(triangles);
}

}  // namespace morsel::core
