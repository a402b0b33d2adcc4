#include "morsel/persistence/plateaus.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/radix_sort.h"
#include "morsel/persistence/st_numbering.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;

/// Vertices a chunk.
constexpr std::size_t kChunk = std::size_t{1} << 13;

/// Plateau ranks a chunk.
constexpr std::size_t kLevels = 128;

class PlateauOrder {
 public:
  /// `node` has an entry a vertex, kNone until its plateau is numbered.
  PlateauOrder(const core::ScalarField& f, std::span<const Index> place, std::span<const Role> roles,
               std::span<Index> node)
      : f_(f), mesh_(f.mesh()), place_(place), roles_(roles), node_(node) {}

  /// Reorders the vertices of one level, which are given in f's order.
  void arrange(const Level& level, std::span<Index> vertices) {
    if (vertices.size() < 2) return;  // as in f
    level_ = level;
    arranged_.clear();
    if (roles_[vertices.front()] == Role::regular) append_plateau(vertices.front());
    if (arranged_.size() < vertices.size()) {  // most levels are one plateau
      if (std::all_of(vertices.begin(), vertices.end(), [&](Index v) { return is_fine(v); })) return;
      const auto minima = std::stable_partition(vertices.begin(), vertices.end(),
                                                [&](Index v) { return roles_[v] == Role::minimum; });
      arranged_.insert(arranged_.begin(), vertices.begin(), minima);
      for (const Index v : vertices)
        if (roles_[v] == Role::regular && node_[v] == kNone) append_plateau(v);
      for (const Index v : vertices)
        if (roles_[v] == Role::maximum) arranged_.push_back(v);
    }
    std::copy(arranged_.begin(), arranged_.end(), vertices.begin());
  }

 private:
  bool is_level(Index u) const { return level_.holds(place_[u]); }

  /// Whether v gets the wanted role if its level keeps f's order. (Survivors always do.)
  bool is_fine(Index v) const {
    if (roles_[v] != Role::regular) return true;
    const auto is_below = [&](Index u) { return is_level(u) ? f_.is_lower(u, v) : place_[u] < level_.first; };
    return !core::vertex_kind(mesh_, v, is_below).is_extremum();
  }

  /// Collects the plateau of `seed`, vertices with a role left out, and appends its vertices in order.
  void append_plateau(Index seed) {
    plateau_.assign(1, seed);
    node_[seed] = 2;
    graph_.clear();
    bool fine = true;
    bool any_source = false;
    bool any_sink = false;
    for (std::size_t i = 0; i < plateau_.size(); ++i) {
      const Index v = plateau_[i];
      bool at_source = false;
      bool at_sink = mesh_.is_boundary_vertex(v);
      bool lower = false;
      bool higher = false;
      graph_.offset.push_back(static_cast<Index>(graph_.adjacent.size()));
      core::for_each_neighbor(mesh_, v, [&](Index u) {
        const bool below = place_[u] < level_.first;
        const bool above = place_[u] >= level_.last;
        at_source |= below;
        at_sink |= above;
        if (below || above) return;
        if (roles_[u] != Role::regular) {
          (roles_[u] == Role::minimum ? at_source : at_sink) = true;
          return;
        }
        if (node_[u] == kNone) {
          node_[u] = static_cast<Index>(plateau_.size() + 2);
          plateau_.push_back(u);
        }
        graph_.adjacent.push_back(node_[u]);
        const bool is_lower = f_.is_lower(u, v);
        lower |= is_lower;
        higher |= !is_lower;
      });
      graph_.at_source.push_back(at_source ? 1 : 0);
      graph_.at_sink.push_back(at_sink ? 1 : 0);
      any_source |= at_source;
      any_sink |= at_sink;
      fine &= (lower || at_source) && (higher || at_sink);
    }
    graph_.offset.push_back(static_cast<Index>(graph_.adjacent.size()));
    if (!any_source || !any_sink)
      throw std::logic_error("cancellation left the plateau of vertex " + std::to_string(seed) +
                             " without anything " + (any_source ? "higher" : "lower") + " beside it");
    if (fine) {
      const auto first = static_cast<std::ptrdiff_t>(arranged_.size());
      arranged_.insert(arranged_.end(), plateau_.begin(), plateau_.end());
      std::sort(arranged_.begin() + first, arranged_.end(),
                [&](Index a, Index b) { return f_.is_lower(a, b); });
      return;
    }
    numbering_.run(graph_, order_);
    if (order_.size() != plateau_.size())
      throw std::logic_error("the plateau of vertex " + std::to_string(seed) + " is not connected");
    for (const Index node : order_) arranged_.push_back(plateau_[node - 2]);
  }

  const core::ScalarField& f_;
  const core::TriangleMesh& mesh_;
  std::span<const Index> place_;
  std::span<const Role> roles_;
  std::span<Index> node_;
  Level level_ = {0, 0};
  std::vector<Index> arranged_, plateau_, order_;
  SourceSinkGraph graph_;
  StNumbering numbering_;
};

/// A vertex that was moved: its rank in f and the first rank of the level it was moved to.
struct Move {
  Index to;
  Index from;
  Index vertex;
};

std::vector<Move> find_moves(const core::ScalarField& f, std::span<const Index> place) {
  const auto rank = f.ranks();
  return core::parallel_reduce(
      0, rank.size(), kChunk, std::vector<Move>{},
      [&](std::size_t first, std::size_t last) {
        std::vector<Move> part;
        for (std::size_t v = first; v < last; ++v)
          if (place[v] != rank[v]) part.push_back({place[v], rank[v], static_cast<Index>(v)});
        return part;
      },
      [](std::vector<Move> sum, const std::vector<Move>& part) {
        sum.insert(sum.end(), part.begin(), part.end());
        return sum;
      });
}

/// The new ranks.
class Reranking {
 public:
  Reranking(const core::ScalarField& f, const Releveled& releveled, std::span<const Role> roles)
      : f_(f),
        releveled_(releveled),
        roles_(roles),
        coming_(find_moves(f, releveled.place)),
        leaving_(coming_.size()),
        rank_(f.order().size(), kNone) {
    const auto bits = static_cast<unsigned>(std::bit_width(rank_.size()));
    core::parallel_for_each(coming_.size(), [&](std::size_t i) { leaving_[i] = coming_[i].from; });
    const std::size_t grain = coming_.size() < core::kGrain ? 2 : 1;  // threads only where they pay
    core::parallel_for(0, 2, grain, [&](std::size_t first, std::size_t last) {
      if (first == 0) {
        core::radix_sort(coming_, bits, [](const Move& move) { return move.from; });
        core::radix_sort(coming_, bits, [](const Move& move) { return move.to; });
      }
      if (last == 2) core::radix_sort(leaving_, bits, [](Index rank) { return rank; });
    });
  }

  core::FlatArray<Index> run() {
    arrange();
    core::parallel_for(0, rank_.size(), kChunk, [&](std::size_t first, std::size_t last) {
      rerank(static_cast<Index>(first), static_cast<Index>(last));
    });
    return std::move(rank_);
  }

 private:
  /// For each level the first vertex moved to it, in coming_, and its lowest new rank.
  struct Start {
    Index comes;
    Index rank;
  };

  std::vector<Start> level_starts() const {
    std::vector<Start> starts;
    starts.reserve(releveled_.levels.size());
    Index leaves = 0;
    Index comes = 0;
    for (const Level& level : releveled_.levels) {
      while (leaves < leaving_.size() && leaving_[leaves] < level.first) ++leaves;
      while (comes < coming_.size() && coming_[comes].to < level.first) ++comes;
      starts.push_back({comes, level.first - leaves + comes});
    }
    return starts;
  }

  /// Appends the vertices of a level in f's order; those moved to it are coming_[comes] and the following
  /// ones.
  void collect(const Level& level, Index comes, std::vector<Index>& vertices) const {
    const auto order = f_.order();
    const auto is_coming = [&] { return comes < coming_.size() && coming_[comes].to == level.first; };
    for (; is_coming() && coming_[comes].from < level.first; ++comes)
      vertices.push_back(coming_[comes].vertex);
    for (Index r = level.first; r < level.last; ++r)
      if (releveled_.place[order[r]] == r) vertices.push_back(order[r]);
    for (; is_coming(); ++comes) vertices.push_back(coming_[comes].vertex);
  }

  /// Ranks the vertices of the levels that vertices were moved to, visiting the levels in memory order.
  void arrange() {
    const auto& levels = releveled_.levels;
    core::FlatArray<Index> visits(levels.size());
    std::iota(visits.begin(), visits.end(), Index{0});
    core::radix_sort(visits, std::bit_width(f_.mesh().triangle_count()),
                     [&](Index l) { return f_.mesh().vertex_halfedge(f_.order()[levels[l].first]) / 3; });
    const std::vector<Start> starts = level_starts();
    core::parallel_for(0, visits.size(), kLevels, [&](std::size_t first, std::size_t last) {
      PlateauOrder plateaus(f_, releveled_.place, roles_, rank_);
      std::vector<Index> vertices;
      for (std::size_t i = first; i < last; ++i) {
        const Level& level = levels[visits[i]];
        vertices.clear();
        collect(level, starts[visits[i]].comes, vertices);
        plateaus.arrange(level, vertices);
        Index next = starts[visits[i]].rank;
        for (const Index v : vertices) rank_[v] = next++;
      }
    });
  }

  /// Ranks all vertices that stay in [begin, end) and are in no such level.
  void rerank(Index begin, Index end) {
    const auto& levels = releveled_.levels;
    auto level =
        std::partition_point(levels.begin(), levels.end(), [&](const Level& l) { return l.last <= begin; });
    auto leaves = std::lower_bound(leaving_.begin(), leaving_.end(), begin);
    auto comes = std::partition_point(coming_.begin(), coming_.end(),
                                      [&](const Move& move) { return move.to < begin; });
    for (Index r = begin; r < end;) {
      if (level != levels.end() && r >= level->first) {
        r = level++->last;
        continue;
      }
      while (leaves != leaving_.end() && *leaves < r) ++leaves;
      while (comes != coming_.end() && comes->to < r) ++comes;
      auto next = static_cast<Index>(r - (leaves - leaving_.begin()) + (comes - coming_.begin()));
      for (const Index stop = level != levels.end() ? std::min(end, level->first) : end; r < stop; ++r) {
        if (leaves != leaving_.end() && *leaves == r)
          ++leaves;
        else
          rank_[f_.order()[r]] = next++;
      }
    }
  }

  const core::ScalarField& f_;
  const Releveled& releveled_;
  std::span<const Role> roles_;
  std::vector<Move> coming_;        // by level, then by rank in f
  core::FlatArray<Index> leaving_;  // their ranks in f, ascending
  core::FlatArray<Index> rank_;
};

}  // namespace

core::FlatArray<Index> order_plateaus(const core::ScalarField& f, const Releveled& releveled,
                                      std::span<const Role> roles) {
  return Reranking(f, releveled, roles).run();
}

}  // namespace morsel::persistence::detail
