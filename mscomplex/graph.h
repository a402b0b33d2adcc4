#pragma once
/// The complex as a Boost.Graph graph. The one header that needs Boost: a project that includes it must also
/// find that package.

#include <boost/graph/adjacency_list.hpp>

#include "morsel/mscomplex/complex.h"

namespace morsel::mscomplex {

/// The properties of an edge of the graph.
struct GraphArc {
  core::Index arc = core::kNone;
  ArcKind kind = ArcKind::descending;
};

/// An undirected multigraph (two arcs may join the same two nodes; none joins a node to itself). Vertex
/// descriptors are node numbers, edges come in the order of arcs; the bundled properties are a Node a vertex
/// and a GraphArc an edge.
using MorseSmaleGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, Node, GraphArc>;

/// The complex's nodes and arcs as a graph; O(nodes + arcs).
inline MorseSmaleGraph graph(const MorseSmaleComplex& complex) {
  MorseSmaleGraph result(complex.node_count());
  for (core::Index n = 0; n < complex.node_count(); ++n) result[n] = complex.node(n);
  for (core::Index a = 0; a < complex.arc_count(); ++a)
    boost::add_edge(complex.arc_saddle(a), complex.arc_end(a), GraphArc{a, MorseSmaleComplex::arc_kind(a)},
                    result);
  return result;
}

}  // namespace morsel::mscomplex
