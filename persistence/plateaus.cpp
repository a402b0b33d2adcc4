#include "morsel/persistence/plateaus.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "morsel/core/link.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;

/// A graph with a source (node 0) and a sink (node 1) that is biconnected once the two are joined.
struct SourceSinkGraph {
  std::vector<Index> offset;    // per node from 2 on, then the end: into `adjacent`
  std::vector<Index> adjacent;  // nodes from 2 on only
  std::vector<bool> at_source;  // per node
  std::vector<bool> at_sink;    // per node

  void clear() {
    offset.assign(2, 0);
    adjacent.clear();
    at_source.assign(2, false);
    at_sink.assign(2, false);
  }
  Index node_count() const { return static_cast<Index>(at_source.size()); }
};

/// Tarjan's st-numbering; buffers are kept between uses.
class StNumbering {
 public:
  /// Replaces `order` by the nodes from 2 on so that each has a neighbour before and one after it.
  void run(const SourceSinkGraph& graph, std::vector<Index>& order) {
    search(graph);
    // Insert each node beside its parent, on the side where its low point lies.
    const Index count = graph.node_count();
    before_.assign(count, kNone);
    after_.assign(count, kNone);
    low_side_is_before_.assign(count, false);
    link(0, 1);
    low_side_is_before_[0] = true;
    for (const Index v : preorder_) {
      const Index parent = parent_[v];
      const bool insert_before = low_side_is_before_[low_[v]];
      if (insert_before) {
        link(before_[parent], v);
        link(v, parent);
      } else {
        link(v, after_[parent]);
        link(parent, v);
      }
      low_side_is_before_[parent] = !insert_before;
    }
    order.clear();
    for (Index v = after_[0]; v != 1; v = after_[v]) order.push_back(v);
  }

 private:
  void link(Index first, Index second) {
    after_[first] = second;
    before_[second] = first;
  }

  /// Depth-first search from the source over the edge to the sink: parents, preorder (source and sink left
  /// out) and low points, the first-visited node that a subtree is adjacent to.
  void search(const SourceSinkGraph& graph) {
    const Index count = graph.node_count();
    number_.assign(count, kNone);
    parent_.assign(count, kNone);
    low_.assign(count, kNone);
    cursor_.assign(count, 0);
    preorder_.clear();
    number_[0] = 0;
    number_[1] = 1;
    parent_[1] = 0;
    const auto lower_low = [&](Index v, Index candidate) {
      if (number_[candidate] < number_[low_[v]]) low_[v] = candidate;
    };
    const auto discover = [&](Index v, Index parent) {
      number_[v] = static_cast<Index>(preorder_.size() + 2);
      parent_[v] = parent;
      low_[v] = graph.at_source[v] ? 0 : graph.at_sink[v] ? 1 : v;
      preorder_.push_back(v);
      stack_.push_back(v);
      cursor_[v] = graph.offset[v];
    };
    for (Index root = 2; root < count; ++root) {
      if (!graph.at_sink[root] || number_[root] != kNone) continue;
      discover(root, 1);
      while (!stack_.empty()) {
        const Index v = stack_.back();
        if (cursor_[v] == graph.offset[v + 1]) {
          stack_.pop_back();
          if (!stack_.empty()) lower_low(stack_.back(), low_[v]);
          continue;
        }
        const Index u = graph.adjacent[cursor_[v]++];
        if (number_[u] == kNone)
          discover(u, v);
        else
          lower_low(v, u);
      }
    }
  }

  std::vector<Index> number_, parent_, low_, cursor_, preorder_, stack_;
  std::vector<Index> before_, after_;
  std::vector<bool> low_side_is_before_;
};

class PlateauOrder {
 public:
  PlateauOrder(const core::ScalarField& f, std::span<const Index> level, std::span<const Role> roles)
      : f_(f), mesh_(f.mesh()), level_(level), roles_(roles), node_(mesh_.vertex_count(), kNone) {}

  /// Reorders the vertices of one level, which come in f's order.
  void arrange(std::span<Index> vertices) {
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
  /// Whether v becomes what it should if its level keeps f's order. (Survivors always do.)
  bool is_fine(Index v) const {
    if (roles_[v] != Role::regular) return true;
    bool lower = false;
    bool higher = mesh_.is_boundary_vertex(v);
    core::for_each_neighbor(mesh_, v, [&](Index u) {
      const bool below = level_[u] != level_[v] ? level_[u] < level_[v] : f_.is_lower(u, v);
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
        if (level_[u] != level_[v]) {
          (level_[u] < level_[v] ? at_source : at_sink) = true;
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
      graph_.at_source.push_back(at_source);
      graph_.at_sink.push_back(at_sink);
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
  std::span<const Index> level_;
  std::span<const Role> roles_;
  std::vector<Index> node_;  // per vertex, kNone until its plateau is numbered
  std::vector<Index> arranged_, plateau_, order_;
  SourceSinkGraph graph_;
  StNumbering numbering_;
};

}  // namespace

std::vector<Index> sort_by_level(const core::ScalarField& f, std::span<const Index> level, Index level_count,
                                 std::vector<Index>& offsets) {
  offsets.assign(std::size_t{level_count} + 1, 0);
  for (const Index l : level) ++offsets[l + 1];
  for (Index l = 0; l < level_count; ++l) offsets[l + 1] += offsets[l];
  std::vector<Index> cursor(offsets.begin(), offsets.end() - 1);
  std::vector<Index> sorted(level.size());
  for (const Index v : f.order()) sorted[cursor[level[v]]++] = v;
  return sorted;
}

std::vector<Index> order_plateaus(const core::ScalarField& f, std::span<const Index> level, Index level_count,
                                  std::span<const Role> roles) {
  std::vector<Index> offsets;
  std::vector<Index> order = sort_by_level(f, level, level_count, offsets);
  PlateauOrder plateaus(f, level, roles);
  for (Index l = 0; l < level_count; ++l)
    if (offsets[l + 1] - offsets[l] > 1)
      plateaus.arrange(std::span<Index>(order).subspan(offsets[l], offsets[l + 1] - offsets[l]));
  std::vector<Index> rank(order.size());
  for (Index i = 0; i < order.size(); ++i) rank[order[i]] = i;
  return rank;
}

}  // namespace morsel::persistence::detail
