#include "support/link_oracle.h"

#include <map>
#include <set>
#include <utility>

namespace morsel::test {
namespace {

using core::Index;
using Graph = std::map<Index, std::set<Index>>;

/// Number of components of the part of the graph that `keep` picks.
template <class Keep>
int count_components(const Graph& graph, const Keep& keep) {
  std::set<Index> seen;
  int count = 0;
  for (const auto& [start, unused] : graph) {
    if (!keep(start) || seen.contains(start)) continue;
    ++count;
    std::vector<Index> stack = {start};
    while (!stack.empty()) {
      const Index u = stack.back();
      stack.pop_back();
      if (!seen.insert(u).second) continue;
      for (const Index w : graph.at(u))
        if (keep(w)) stack.push_back(w);
    }
  }
  return count;
}

}  // namespace

std::vector<LinkComponents> link_components(const core::TriangleMesh& mesh,
                                            const std::vector<double>& values) {
  std::vector<Graph> links(mesh.vertex_count());
  for (const core::Triangle& t : mesh.triangles())
    for (int i = 0; i < 3; ++i) {
      const Index a = t[(i + 1) % 3];
      const Index b = t[(i + 2) % 3];
      links[t[i]][a].insert(b);
      links[t[i]][b].insert(a);
    }
  std::vector<LinkComponents> result(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    std::vector<Index> ends;
    for (const auto& [u, joined] : links[v])
      if (joined.size() == 1) ends.push_back(u);
    for (const Index u : ends) {  // a fan: the cap, above everything, closes its link
      links[v][u].insert(core::kNone);
      links[v][core::kNone].insert(u);
    }
    const auto lower = [&](Index u) {
      return u != core::kNone && std::pair(values[u], u) < std::pair(values[v], v);
    };
    result[v].lower = count_components(links[v], lower);
    result[v].upper = count_components(links[v], [&](Index u) { return !lower(u); });
  }
  return result;
}

}  // namespace morsel::test
