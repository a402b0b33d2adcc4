#include "morsel/persistence/diagram.h"

#include <algorithm>
#include <array>

namespace morsel::persistence {

std::string_view to_string(PairKind kind) {
  static constexpr std::array<std::string_view, 3> kNames = {"minimum-saddle", "saddle-maximum",
                                                             "saddle-cap"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::size_t Diagram::count_above(double threshold) const {
  const auto finite = finite_pairs();
  const auto above =
      std::upper_bound(finite.begin(), finite.end(), threshold,
                       [](double t, const PersistencePair& pair) { return t < pair.persistence(); });
  return static_cast<std::size_t>(finite.end() - above);
}

std::vector<double> vertex_persistence(const Diagram& diagram, Index vertex_count) {
  std::vector<double> result(vertex_count, 0);
  for (const PersistencePair& pair : diagram.pairs) {
    if (pair.kind != PairKind::saddle_cap) result[pair.extremum] = pair.persistence();
    result[pair.saddle] = std::max(result[pair.saddle], pair.persistence());
  }
  for (const EssentialExtrema& extrema : diagram.essential_extrema) {
    result[extrema.minimum] = kInfinite;
    if (!extrema.top_is_cap) result[extrema.top] = kInfinite;
  }
  for (const EssentialSaddle& saddle : diagram.essential_saddles) result[saddle.vertex] = kInfinite;
  return result;
}

std::vector<Index> persistent_extrema(const Diagram& diagram, std::size_t count) {
  std::vector<Index> extrema;
  for (const EssentialExtrema& essential : diagram.essential_extrema) {
    extrema.push_back(essential.minimum);
    if (!essential.top_is_cap) extrema.push_back(essential.top);
  }
  const auto finite = diagram.finite_pairs();
  for (std::size_t i = finite.size(); i-- > 0 && extrema.size() < count;)
    extrema.push_back(finite[i].extremum);
  if (extrema.size() > count) extrema.resize(count);
  return extrema;
}

}  // namespace morsel::persistence
