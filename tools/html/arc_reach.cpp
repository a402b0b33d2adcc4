#include "morsel/tools/html/arc_reach.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>

#include "morsel/core/parallel/stop.h"

namespace morsel::tools::html {
namespace {

using core::Index;
using core::kNone;
using mscomplex::ArcKind;
using mscomplex::Cancellation;
using mscomplex::MorseSmaleComplex;

/// Follows, from the last saddle to be cancelled to the first, each saddle's arcs as they are when it is
/// cancelled. Saddles that were visited are not visited again: the paths from there are the same, and end
/// earlier. So each saddle is visited once.
class Passage {
 public:
  Passage(const mscomplex::PersistenceHierarchy& hierarchy, ArcKind kind)
      : complex_(hierarchy.complex()), cancellations_(hierarchy.cancellations()) {
    const Index saddles = complex_.saddle_count();
    turn_.assign(saddles, kNone);
    cancelled_by_.assign(complex_.node_count(), kNone);
    for (Index i = 0; i < cancellations_.size(); ++i) {
      turn_[cancellations_[i].arc / 4] = i;
      cancelled_by_[cancellations_[i].extremum] = i;
    }
    arcs_.resize(saddles);
    for (Index s = 0; s < saddles; ++s) {
      std::size_t found = 0;
      for (Index arc = 4 * s; arc < 4 * s + 4; ++arc)
        if (MorseSmaleComplex::arc_kind(arc) == kind) arcs_[s].at(found++) = arc;
    }
  }

  std::vector<double> reach() {
    const Index saddles = complex_.saddle_count();
    std::vector<Index> order(saddles);
    std::iota(order.begin(), order.end(), Index{0});
    // kNone, of what is never cancelled, is the largest index.
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return turn_[a] > turn_[b]; });
    std::vector<double> reach(saddles, -1);
    std::vector<Index> open;
    for (const Index from : order) {
      core::throw_if_stopped();
      if (reach[from] >= 0) continue;
      const double own = turn_[from] == kNone ? std::numeric_limits<double>::infinity()
                                              : cancellations_[turn_[from]].persistence;
      reach[from] = own;
      open.push_back(from);
      while (!open.empty()) {
        const Index s = open.back();
        open.pop_back();
        for (const Index arc : arcs_[s]) {
          Index end = complex_.arc_end(arc);
          while (cancelled_by_[end] < turn_[s]) {  // so neither is kNone
            const Cancellation& cancellation = cancellations_[cancelled_by_[end]];
            const Index passed = cancellation.arc / 4;
            if (reach[passed] >= 0) break;
            reach[passed] = own;
            open.push_back(passed);
            end = cancellation.survivor;
          }
        }
      }
    }
    return reach;
  }

 private:
  const MorseSmaleComplex& complex_;
  std::span<const Cancellation> cancellations_;
  std::vector<Index> turn_;          // per saddle: its cancellation
  std::vector<Index> cancelled_by_;  // per node of an extremum, likewise
  std::vector<std::array<Index, 2>> arcs_;
};

}  // namespace

std::vector<double> arc_reach(const mscomplex::PersistenceHierarchy& hierarchy, ArcKind kind) {
  return Passage(hierarchy, kind).reach();
}

}  // namespace morsel::tools::html
