#include "morsel/persistence/plateaus.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "morsel/core/link.h"
#include "morsel/core/parallel.h"
#include "morsel/core/parallel_sort.h"
#include "morsel/persistence/st_numbering.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;

/// Vertices a chunk.
constexpr std::size_t kChunk = std::size_t{1} << 15;

class PlateauOrder {
 public:
  /// `node` has an entry a vertex, kNone until its plateau is numbered.
  PlateauOrder(const core::ScalarField& f, std::span<const Index> place, std::span<const Role> roles,
               std::span<Index> node)
      : f_(f), mesh_(f.mesh()), place_(place), roles_(roles), node_(node) {}

  /// Reorders the vertices of one level, which come in f's order.
  void arrange(const Level& level, std::span<Index> vertices) {
    level_ = level;
    if (std::all_of(vertices.begin(), vertices.end(), [&](Index v) { return is_fine(v); })) return;
    arranged_.clear();
    for (const Index v : vertices)
      if (roles_[v] == Role::minimum) arranged_.push_back(v);
    for (const Index v : vertices)
      if (roles_[v] == Role::regular && node_[v] == kNone) append_plateau(v);
    for (const Index v : vertices)
      if (roles_[v] == Role::maximum) arranged_.push_back(v);
    std::copy(arranged_.begin(), arranged_.end(), vertices.begin());
  }

 private:
  bool is_level(Index u) const { return level_.holds(place_[u]); }

  /// Whether v becomes what it should if its level keeps f's order. (Survivors always do.)
  bool is_fine(Index v) const {
    if (roles_[v] != Role::regular) return true;
    bool lower = false;
    bool higher = mesh_.is_boundary_vertex(v);
    core::for_each_neighbor(mesh_, v, [&](Index u) {
      const bool below = is_level(u) ? f_.is_lower(u, v) : place_[u] < level_.first;
      lower |= below;
      higher |= !below;
    });
    return lower && higher;
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
        if (!is_level(u)) {
          (place_[u] < level_.first ? at_source : at_sink) = true;
        } else if (roles_[u] != Role::regular) {
          (roles_[u] == Role::minimum ? at_source : at_sink) = true;
        } else {
          if (node_[u] == kNone) {
            node_[u] = static_cast<Index>(plateau_.size() + 2);
            plateau_.push_back(u);
          }
          graph_.adjacent.push_back(node_[u]);
          (f_.is_lower(u, v) ? lower : higher) = true;
        }
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

/// A vertex that was moved: its rank in f and the first rank of the level it came to.
struct Move {
  Index to;
  Index from;
};

/// By ascending rank in f.
std::vector<Move> find_moves(const core::ScalarField& f, std::span<const Index> place) {
  const auto order = f.order();
  return core::parallel_reduce(
      0, order.size(), kChunk, std::vector<Move>{},
      [&](std::size_t first, std::size_t last) {
        std::vector<Move> part;
        for (auto r = static_cast<Index>(first); r < last; ++r)
          if (place[order[r]] != r) part.push_back({place[order[r]], r});
        return part;
      },
      [](std::vector<Move> sum, const std::vector<Move>& part) {
        sum.insert(sum.end(), part.begin(), part.end());
        return sum;
      });
}

/// Writes the new ranks of all vertices that have their places in some range of f's ranks.
class Reranking {
 public:
  Reranking(const core::ScalarField& f, const Releveled& releveled, std::span<const Role> roles)
      : f_(f),
        releveled_(releveled),
        roles_(roles),
        leaving_(find_moves(f, releveled.place)),
        coming_(leaving_),
        node_(f.order().size(), kNone),
        rank_(f.order().size()) {
    core::parallel_sort(coming_.begin(), coming_.end(), [](const Move& a, const Move& b) {
      return a.to != b.to ? a.to < b.to : a.from < b.from;
    });
  }

  std::vector<Index> run() {
    core::parallel_for(0, rank_.size(), kChunk, [&](std::size_t first, std::size_t last) {
      rerank(static_cast<Index>(first), static_cast<Index>(last));
    });
    return std::move(rank_);
  }

 private:
  /// All that stays in [begin, end) and the levels that start there.
  void rerank(Index begin, Index end) {
    const auto& levels = releveled_.levels;
    auto level =
        std::partition_point(levels.begin(), levels.end(), [&](const Level& l) { return l.first < begin; });
    if (level != levels.begin()) begin = std::max(begin, std::prev(level)->last);
    auto leaves = std::partition_point(leaving_.begin(), leaving_.end(),
                                       [&](const Move& move) { return move.from < begin; });
    auto comes = std::partition_point(coming_.begin(), coming_.end(),
                                      [&](const Move& move) { return move.to < begin; });
    Index next =
        begin - static_cast<Index>(leaves - leaving_.begin()) + static_cast<Index>(comes - coming_.begin());
    PlateauOrder plateaus(f_, releveled_.place, roles_, node_);
    std::vector<Index> vertices;
    const auto keep = [&](Index first, Index last, const auto& visit) {
      for (Index r = first; r < last; ++r) {
        if (leaves != leaving_.end() && leaves->from == r)
          ++leaves;
        else
          visit(f_.order()[r]);
      }
    };
    const auto append = [&](Index v) { vertices.push_back(v); };
    const auto assign = [&](Index v) { rank_[v] = next++; };
    Index r = begin;
    for (; level != levels.end() && level->first < end; ++level) {
      keep(r, level->first, assign);
      vertices.clear();
      for (; comes != coming_.end() && comes->to == level->first && comes->from < level->first; ++comes)
        append(f_.order()[comes->from]);
      keep(level->first, level->last, append);
      for (; comes != coming_.end() && comes->to == level->first; ++comes) append(f_.order()[comes->from]);
      plateaus.arrange(*level, vertices);
      for (const Index v : vertices) assign(v);
      r = level->last;
    }
    keep(r, std::max(r, end), assign);
  }

  const core::ScalarField& f_;
  const Releveled& releveled_;
  std::span<const Role> roles_;
  std::vector<Move> leaving_;  // by rank in f
  std::vector<Move> coming_;   // by level, then by rank in f
  std::vector<Index> node_;
  std::vector<Index> rank_;
};

}  // namespace

std::vector<Index> order_plateaus(const core::ScalarField& f, const Releveled& releveled,
                                  std::span<const Role> roles) {
  return Reranking(f, releveled, roles).run();
}

}  // namespace morsel::persistence::detail
