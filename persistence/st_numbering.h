#pragma once
/// Numberings between a source and a sink. For the module's own use.

#include <cstdint>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::persistence::detail {

using core::Index;

/// A graph with a source (node 0) and a sink (node 1) that is biconnected once the two are joined.
struct SourceSinkGraph {
  std::vector<Index> offset;            // per node from 0 on, then the end: into `adjacent`
  std::vector<Index> adjacent;          // nodes from 2 on only
  std::vector<std::uint8_t> at_source;  // per node
  std::vector<std::uint8_t> at_sink;    // per node

  void clear();
  Index node_count() const { return static_cast<Index>(at_source.size()); }
};

/// An st-numbering (Tarjan 1986, "Two streamlined depth-first search algorithms"); keeps its buffers.
class StNumbering {
 public:
  /// Replaces `order` by the nodes from 2 on so that each has a neighbour before and one after it; O(size of
  /// the graph). Nodes that are not connected to the sink are left out.
  void run(const SourceSinkGraph& graph, std::vector<Index>& order);

 private:
  void link(Index first, Index second);
  void search(const SourceSinkGraph& graph);

  std::vector<Index> number_, parent_, low_, cursor_, preorder_, stack_;
  std::vector<Index> before_, after_;
  std::vector<std::uint8_t> low_side_is_before_;
};

}  // namespace morsel::persistence::detail
