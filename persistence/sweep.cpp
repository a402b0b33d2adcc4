#include "morsel/persistence/sweep.h"

#include <algorithm>
#include <span>
#include <utility>

#include "morsel/core/link.h"
#include "morsel/core/parallel.h"
#include "morsel/core/union_find.h"
#include "morsel/persistence/link_changes.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// The critical vertices, each kind by ascending rank.
struct Critical {
  std::vector<Index> minima, maxima;
  std::vector<Saddle> saddles;
};

/// For those whose number of changes was cut off.
Index multiplicity(const core::ScalarField& field, Index v) {
  const auto lower = core::link_part(
      field.mesh(), v, /*cap_inside=*/false, [&](Index u) { return field.is_lower(u, v); }, [](Index) {});
  return lower.runs - 1;
}

Critical critical_vertices(const core::ScalarField& field, std::span<const std::uint8_t> changes) {
  const core::TriangleMesh& mesh = field.mesh();
  const auto order = field.order();
  return core::parallel_reduce(
      0, order.size(), std::size_t{1} << 16, Critical{},
      [&](std::size_t begin, std::size_t end) {
        Critical part;
        for (auto r = static_cast<Index>(begin); r < end; ++r) {
          const Index v = order[r];
          const std::uint8_t count = changes[v];
          if (count == kRegular) continue;
          if (count != kExtremum)
            part.saddles.push_back({r, count < kMostChanges ? Index{count} / 2 - 1 : multiplicity(field, v)});
          else if (field.is_lower(mesh.target(mesh.vertex_halfedge(v)), v))
            part.maxima.push_back(v);
          else
            part.minima.push_back(v);
        }
        return part;
      },
      [](Critical sum, const Critical& part) {
        append(sum.minima, part.minima);
        append(sum.maxima, part.maxima);
        append(sum.saddles, part.saddles);
        return sum;
      });
}

/// The runs of lower and of higher elements around a vertex of the capped surface, each by its element that
/// lies farthest from the vertex.
class LinkRuns {
 public:
  explicit LinkRuns(const core::ScalarField& field) : mesh_(field.mesh()), rank_(field.ranks()) {}

  void walk(Index v) {
    runs_.clear();
    const Index center = rank_[v];
    if (mesh_.is_boundary_vertex(v))
      runs_.push_back({true, kNone, mesh_.vertex_count() + mesh_.boundary_loop_of_vertex(v)});
    core::for_each_neighbor(mesh_, v, [&](Index u) {
      const Index r = rank_[u];
      const Run run = {r > center, r, u};
      if (runs_.empty() || runs_.back().higher != run.higher)
        runs_.push_back(run);
      else
        runs_.back().take(run);
    });
    if (runs_.size() > 1 && runs_.front().higher == runs_.back().higher) {
      runs_.front().take(runs_.back());
      runs_.pop_back();
    }
  }

  /// Calls visit(u) for an element of each run, a cap being vertex_count + loop.
  template <class Visit>
  void for_each(bool higher, const Visit& visit) const {
    for (const Run& run : runs_)
      if (run.higher == higher) visit(run.farthest);
  }

 private:
  struct Run {
    bool higher;
    Index rank;
    Index farthest;
    void take(const Run& other) {
      if (higher ? other.rank > rank : other.rank < rank) *this = other;
    }
  };
  const core::TriangleMesh& mesh_;
  std::span<const Index> rank_;
  std::vector<Run> runs_;
};

/// Fills the merges of both sweeps. Saddles are visited in the order of their vertices, as they lie in memory,
/// and write to where their rank puts them.
void find_merges(const core::ScalarField& field, std::span<const std::uint8_t> changes, Sweeps& sweeps) {
  const auto order = field.order();
  std::vector<Index> slot(order.size());
  Index slots = 0;
  for (const Saddle& saddle : sweeps.saddles) {
    slot[order[saddle.rank]] = slots;
    slots += saddle.multiplicity;
  }
  sweeps.up.merges.resize(slots);
  sweeps.down.merges.resize(slots);
  core::parallel_for(0, order.size(), core::kGrain, [&](std::size_t begin, std::size_t end) {
    LinkRuns runs(field);
    std::vector<Index> buffer;
    const auto collect = [&](const Sweep& sweep, bool higher, Index saddle, Merge* merge) {
      Index first = kNone;
      runs.for_each(higher, [&](Index u) {
        const Index basin = sweep.paths->find(u, buffer);
        if (first == kNone)
          first = basin;
        else
          *merge++ = {saddle, first, basin};
      });
    };
    for (auto v = static_cast<Index>(begin); v < end; ++v) {
      if (changes[v] <= kRegular) continue;
      runs.walk(v);
      collect(sweeps.up, false, field.rank(v), &sweeps.up.merges[slot[v]]);
      collect(sweeps.down, true, field.rank(v), &sweeps.down.merges[slot[v]]);
    }
  });
}

/// The elder rule: keeps the merges that join components and notes which basin each of them ends.
void unite(Sweep& sweep) {
  core::UnionFind components(sweep.basin_count());  // roots are the eldest
  std::size_t kept = 0;
  for (const Merge& merge : sweep.merges) {
    const Index a = components.find(merge.a);
    const Index b = components.find(merge.b);
    if (a == b) continue;
    components.unite(a, b);
    sweep.deaths.push_back({std::max(a, b), merge.saddle});
    for (std::size_t i = sweep.deaths.size() - 1; i > 0 && sweep.deaths[i - 1].saddle == merge.saddle &&
                                                  sweep.deaths[i - 1].basin < sweep.deaths[i].basin;
         --i)
      std::swap(sweep.deaths[i - 1], sweep.deaths[i]);
    sweep.merges[kept++] = merge;
  }
  sweep.merges.resize(kept);
  sweep.merges.shrink_to_fit();
}

}  // namespace

Sweeps sweep(const core::ScalarField& field, const core::Progress& progress) {
  const core::TriangleMesh& mesh = field.mesh();
  const Index n = mesh.vertex_count();
  const std::vector<std::uint8_t> changes = link_changes(mesh, field.ranks());
  Critical critical = critical_vertices(field, changes);
  progress.throw_if_cancelled();

  Sweeps result;
  result.saddles = std::move(critical.saddles);
  result.up.vertex_count = n;
  result.down.vertex_count = n;
  result.up.extremum = std::move(critical.minima);
  for (Index loop = mesh.boundary_loop_count(); loop-- > 0;) result.down.extremum.push_back(n + loop);
  result.down.extremum.insert(result.down.extremum.end(), critical.maxima.rbegin(), critical.maxima.rend());
  result.up.paths = std::make_unique<SteepestPaths>(mesh, field.ranks(), Direction::up, result.up.extremum);
  result.down.paths =
      std::make_unique<SteepestPaths>(mesh, field.ranks(), Direction::down, result.down.extremum);
  find_merges(field, changes, result);
  progress.throw_if_cancelled();
  core::parallel_for(0, 2, 1, [&](std::size_t which, std::size_t) {
    Sweep& sweep = which == 0 ? result.up : result.down;
    if (which == 1) std::reverse(sweep.merges.begin(), sweep.merges.end());
    unite(sweep);
  });
  return result;
}

}  // namespace morsel::persistence::detail
