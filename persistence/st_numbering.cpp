#include "morsel/persistence/st_numbering.h"

namespace morsel::persistence::detail {

using core::kNone;

void SourceSinkGraph::clear() {
  offset.assign(2, 0);
  adjacent.clear();
  at_source.assign(2, 0);
  at_sink.assign(2, 0);
}

void StNumbering::run(const SourceSinkGraph& graph, std::vector<Index>& order) {
  search(graph);
  // Insert each node beside its parent, on the side where its low point lies.
  const Index count = graph.node_count();
  before_.assign(count, kNone);
  after_.assign(count, kNone);
  low_side_is_before_.assign(count, 0);
  link(0, 1);
  low_side_is_before_[0] = 1;
  for (const Index v : preorder_) {
    const Index parent = parent_[v];
    const bool insert_before = low_side_is_before_[low_[v]] != 0;
    if (insert_before) {
      link(before_[parent], v);
      link(v, parent);
    } else {
      link(v, after_[parent]);
      link(parent, v);
    }
    low_side_is_before_[parent] = insert_before ? 0 : 1;
  }
  order.clear();
  for (Index v = after_[0]; v != 1; v = after_[v]) order.push_back(v);
}

void StNumbering::link(Index first, Index second) {
  after_[first] = second;
  before_[second] = first;
}

/// Depth-first search from the source over the edge to the sink: parents, preorder (source and sink left
/// out) and low points, the first-visited node that a subtree is adjacent to.
void StNumbering::search(const SourceSinkGraph& graph) {
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
    low_[v] = graph.at_source[v] != 0 ? 0 : graph.at_sink[v] != 0 ? 1 : v;
    preorder_.push_back(v);
    stack_.push_back(v);
    cursor_[v] = graph.offset[v];
  };
  for (Index root = 2; root < count; ++root) {
    if (graph.at_sink[root] == 0 || number_[root] != kNone) continue;
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

}  // namespace morsel::persistence::detail
