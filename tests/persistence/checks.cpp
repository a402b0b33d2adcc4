#include "checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "morsel/core/field/link.h"
#include "morsel/morse/critical_points.h"
#include "morsel/persistence/pairing.h"
#include "support/phat_oracle.h"

namespace morsel::test {

using core::Index;
using core::ScalarField;
using morse::CriticalType;
using persistence::Diagram;
using persistence::PairKind;
using persistence::PersistencePair;

namespace {

std::string at(Index v) { return " at vertex " + std::to_string(v); }

/// The lowest value over which each vertex reaches a seed.
std::vector<double> reached_over(const core::TriangleMesh& mesh, const std::vector<double>& ground,
                                 const std::set<Index>& seeds) {
  std::vector<double> reached(ground.size(), std::numeric_limits<double>::infinity());
  std::set<std::pair<double, Index>> front;
  for (const Index v : seeds) front.emplace(reached[v] = ground[v], v);
  while (!front.empty()) {
    const Index v = front.begin()->second;
    front.erase(front.begin());
    core::for_each_neighbor(mesh, v, [&](Index u) {
      const double over = std::max(reached[v], ground[u]);
      if (over < reached[u]) front.emplace(reached[u] = over, u);
    });
  }
  return reached;
}

std::vector<double> negated(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}

/// Flooding from the minima that stay, then carving from the maxima that do and from boundaries.
std::vector<double> flooded_and_carved(const ScalarField& f, const std::set<Index>& minima,
                                       const std::set<Index>& maxima) {
  const core::TriangleMesh& mesh = f.mesh();
  std::set<Index> tops = maxima;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.is_boundary_vertex(v)) tops.insert(v);
  const auto flooded = reached_over(mesh, {f.values().begin(), f.values().end()}, minima);
  return negated(reached_over(mesh, negated(flooded), tops));
}

}  // namespace

std::string diagram_contradiction(const ScalarField& field, const Diagram& diagram) {
  const core::TriangleMesh& mesh = field.mesh();
  const std::size_t components = mesh.component_count();
  std::vector<long> left(components, 0);  // saddle multiplicity not accounted for
  std::map<Index, Index> left_at;
  std::set<Index> extrema;
  const auto points = morse::classify(field);
  for (const auto& point : points.points) {
    if (point.type == CriticalType::saddle) {
      left[mesh.component_of_vertex(point.vertex)] += point.multiplicity;
      left_at[point.vertex] = point.multiplicity;
    } else {
      extrema.insert(point.vertex);
    }
  }
  std::set<Index> caps;
  for (Index loop = 0; loop < mesh.boundary_loop_count(); ++loop) caps.insert(loop);

  for (const PersistencePair& pair : diagram.pairs) {
    const bool cap = pair.kind == PairKind::saddle_cap;
    if ((cap ? caps : extrema).erase(pair.extremum) != 1) return "no extremum to pair" + at(pair.extremum);
    if (left_at[pair.saddle]-- == 0) return "too many pairs" + at(pair.saddle);
    --left[mesh.component_of_vertex(pair.saddle)];
    const bool up = pair.kind == PairKind::minimum_saddle;
    if (!cap && field.is_lower(pair.extremum, pair.saddle) != up)
      return "a pair the wrong way round" + at(pair.saddle);
    if (pair.birth != field.value(up ? pair.extremum : pair.saddle)) return "wrong birth" + at(pair.saddle);
    if (pair.death != (cap ? INFINITY : field.value(up ? pair.saddle : pair.extremum)))
      return "wrong death" + at(pair.saddle);
  }
  for (const auto& [vertex, count] : diagram.essential_saddles) {
    if (count == 0 || left_at[vertex] != count) return "wrong count of essential saddles" + at(vertex);
    left_at[vertex] = 0;
    left[mesh.component_of_vertex(vertex)] -= count;
  }
  for (const auto& [vertex, count] : left_at)
    if (count != 0) return "multiplicity left over" + at(vertex);
  std::vector<Index> handles(components, 0);
  for (const auto& [vertex, count] : diagram.essential_saddles)
    handles[mesh.component_of_vertex(vertex)] += count;
  for (Index c = 0; c < components; ++c) {
    if (left[c] != 0) return "multiplicity left over in component " + std::to_string(c);
    if (handles[c] != 2 * mesh.genus(c)) return "not 2g essential saddles in component " + std::to_string(c);
    const auto& essential = diagram.essential_extrema[c];
    if (extrema.erase(essential.minimum) != 1) return "the essential minimum is none" + at(essential.minimum);
    if (mesh.component_of_vertex(essential.minimum) != c) return "essential minimum elsewhere";
    if (essential.top_is_cap != (mesh.boundary_loop_count(c) > 0)) return "wrong kind of top";
    if ((essential.top_is_cap ? caps : extrema).erase(essential.top) != 1)
      return "the essential top is none" + at(essential.top);
  }
  if (!extrema.empty()) return "an extremum without a pair" + at(*extrema.begin());
  if (!caps.empty()) return "a cap without a pair";

  for (std::size_t i = 0; i < diagram.pairs.size(); ++i) {
    const PersistencePair& pair = diagram.pairs[i];
    if ((pair.kind == PairKind::saddle_cap) != (i >= diagram.finite_count)) return "finite pairs misplaced";
    if (i > 0 && diagram.pairs[i - 1].persistence() > pair.persistence()) return "pairs out of order";
  }
  for (const double t : {-1.0, 0.0, 0.1, 1.0, field.extent() / 2}) {
    const auto above = std::count_if(diagram.pairs.begin(), diagram.pairs.end(), [&](const auto& pair) {
      return pair.kind != PairKind::saddle_cap && pair.persistence() > t;
    });
    if (diagram.count_above(t) != static_cast<std::size_t>(above)) return "wrong number of pairs above";
  }
  const auto persistence = persistence::vertex_persistence(diagram, mesh.vertex_count());
  for (const PersistencePair& pair : diagram.pairs) {
    if (pair.kind != PairKind::saddle_cap && persistence[pair.extremum] != pair.persistence())
      return "wrong persistence" + at(pair.extremum);
    if (persistence[pair.saddle] < pair.persistence()) return "too small a persistence" + at(pair.saddle);
  }
  return {};
}

std::string oracle_contradiction(const ScalarField& field, const Diagram& diagram) {
  const Index n = field.mesh().vertex_count();
  OracleDiagram ours;
  for (const PersistencePair& pair : diagram.pairs) {
    if (pair.kind == PairKind::minimum_saddle)
      ours.pairs.emplace_back(0, pair.extremum, pair.saddle);
    else
      ours.pairs.emplace_back(1, pair.saddle,
                              pair.kind == PairKind::saddle_cap ? n + pair.extremum : pair.extremum);
  }
  for (const auto& extrema : diagram.essential_extrema) {
    ours.essential.emplace_back(0, extrema.minimum);
    ours.essential.emplace_back(2, extrema.top_is_cap ? n + extrema.top : extrema.top);
  }
  for (const auto& saddle : diagram.essential_saddles)
    for (Index i = 0; i < saddle.count; ++i) ours.essential.emplace_back(1, saddle.vertex);
  std::sort(ours.pairs.begin(), ours.pairs.end());
  std::sort(ours.essential.begin(), ours.essential.end());
  const OracleDiagram oracle = phat_diagram(field);
  if (ours.pairs != oracle.pairs) return "other pairs than PHAT's";
  if (ours.essential != oracle.essential) return "other essential classes than PHAT's";
  return {};
}

std::string cancellation_contradiction(const ScalarField& f, const Diagram& diagram, std::size_t cancelled,
                                       const ScalarField& g, bool threshold_mode) {
  const core::TriangleMesh& mesh = f.mesh();
  if (!g.mesh().is_same(mesh)) return "another mesh";
  const double t = cancelled == 0 ? 0 : diagram.pairs[cancelled - 1].persistence();
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!(std::abs(g.value(v) - f.value(v)) <= t)) return "moved by more than the threshold" + at(v);

  std::set<std::pair<Index, CriticalType>> wanted;
  for (const auto& extrema : diagram.essential_extrema) {
    wanted.emplace(extrema.minimum, CriticalType::minimum);
    if (!extrema.top_is_cap) wanted.emplace(extrema.top, CriticalType::maximum);
  }
  for (const PersistencePair& pair : diagram.finite_pairs().subspan(cancelled))
    wanted.emplace(pair.extremum,
                   pair.kind == PairKind::minimum_saddle ? CriticalType::minimum : CriticalType::maximum);
  std::vector<Index> survivors;
  std::set<Index> minima, maxima;
  for (const auto& [vertex, type] : wanted) {
    (type == CriticalType::minimum ? minima : maxima).insert(vertex);
    survivors.push_back(vertex);
    if (g.value(vertex) != f.value(vertex)) return "the value of a survivor changed" + at(vertex);
  }
  if (!std::equal(g.values().begin(), g.values().end(), flooded_and_carved(f, minima, maxima).begin()))
    return "values that are not those of flooding and carving";
  std::vector<long> euler(mesh.component_count(), 0);
  for (const auto& point : morse::classify(g).points) {
    euler[mesh.component_of_vertex(point.vertex)] +=
        point.type == CriticalType::saddle ? -long{point.multiplicity} : 1;
    if (point.type != CriticalType::saddle && wanted.erase({point.vertex, point.type}) == 0)
      return "an extremum that should be gone" + at(point.vertex);
  }
  if (!wanted.empty()) return "an extremum that should have stayed" + at(wanted.begin()->first);
  for (Index c = 0; c < mesh.component_count(); ++c)
    if (euler[c] != mesh.euler_characteristic(c)) return "the Euler identity fails";

  std::sort(survivors.begin(), survivors.end(), [&](Index a, Index b) { return f.is_lower(a, b); });
  for (std::size_t i = 1; i < survivors.size(); ++i) {
    const Index a = survivors[i - 1], b = survivors[i];
    // Minima go below and maxima above all else of their value, so only like ones are compared.
    if (g.value(a) == g.value(b) && !g.is_lower(a, b) &&
        morse::classify_vertex(g, a).type == morse::classify_vertex(g, b).type)
      return "survivors of equal value changed their order" + at(a);
  }

  const Diagram after = persistence::pair_extrema(g);
  if (after.essential_extrema != diagram.essential_extrema) return "other essential extrema";
  if (after.cap_pairs().size() != diagram.cap_pairs().size()) return "another number of infinite pairs";
  if (after.finite_count != diagram.finite_count - cancelled) return "another number of pairs";
  if (threshold_mode && after.count_above(0) != diagram.finite_count - cancelled)
    return "a pair that shrank to nothing";
  return {};
}

}  // namespace morsel::test
