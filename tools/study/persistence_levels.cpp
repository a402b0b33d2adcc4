#include "morsel/tools/study/persistence_levels.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "morsel/persistence/diagram.h"

namespace morsel::tools {
namespace {

using core::Index;
using mscomplex::NodeKind;
using mscomplex::PersistenceHierarchy;

std::size_t critical_cells(const PersistenceHierarchy& hierarchy, Index level) {
  return std::size_t{hierarchy.minimum_count(level)} + hierarchy.saddle_count(level) +
         hierarchy.maximum_count(level);
}

double persistence_of(const PersistenceHierarchy& hierarchy, Index node) {
  const Index gone = hierarchy.last_level(node);
  return gone == core::kNone ? persistence::kInfinite : hierarchy.cancellations()[gone - 1].persistence;
}

morse::CriticalType type_of(NodeKind kind) {
  return kind == NodeKind::minimum  ? morse::CriticalType::minimum
         : kind == NodeKind::saddle ? morse::CriticalType::saddle
                                    : morse::CriticalType::maximum;
}

/// The nodes alive at a level as critical points, those of one saddle vertex as one; and their persistence.
void collect_points(const PersistenceHierarchy& hierarchy, Index level, LevelSeed& seed) {
  struct Entry {
    morse::CriticalPoint point;
    double persistence;
  };
  const mscomplex::MorseSmaleComplex& complex = hierarchy.complex();
  std::vector<Entry> entries;
  for (Index n = 0; n < complex.node_count(); ++n) {
    const mscomplex::Node node = complex.node(n);
    if (node.kind == NodeKind::cap || !hierarchy.is_alive(n, level)) continue;
    const double persistence = persistence_of(hierarchy, n);
    if (!entries.empty() && entries.back().point.vertex == node.vertex) {  // of one saddle they are in a row
      ++entries.back().point.multiplicity;
      entries.back().persistence = std::max(entries.back().persistence, persistence);
    } else {
      entries.push_back({{node.vertex, type_of(node.kind), 1}, persistence});
    }
  }
  std::ranges::sort(entries, {}, [](const Entry& entry) { return entry.point.vertex; });
  seed.points.points.reserve(entries.size());
  seed.persistence.reserve(entries.size());
  for (const Entry& entry : entries) {
    seed.points.points.push_back(entry.point);
    seed.persistence.push_back(entry.persistence);
    if (entry.point.type == morse::CriticalType::saddle) ++seed.points.saddles;
  }
  seed.points.minima = hierarchy.minimum_count(level);
  seed.points.saddle_multiplicity = hierarchy.saddle_count(level);
  seed.points.maxima = hierarchy.maximum_count(level);
}

LevelSeed seed_of(const FieldHierarchy& from, Index level, bool is_finest, LevelName name) {
  LevelSeed seed;
  name.cancelled->cancellations = level;
  name.cancelled->largest = level == 0 ? 0 : from.hierarchy->cancellations()[level - 1].persistence;
  seed.name = std::move(name);
  seed.field = from.field;
  collect_points(*from.hierarchy, level, seed);
  seed.parents.reserve(seed.points.points.size());
  for (const morse::CriticalPoint& point : seed.points.points)
    seed.parents.push_back(is_finest ? core::kNone : point.vertex);
  seed.gradient = [hierarchy = from.hierarchy, level] { return hierarchy->gradient(level); };
  return seed;
}

/// The reason why another number of critical cells than the wanted one is left.
std::string note_on(std::size_t wanted, std::size_t left, Index level, Index levels) {
  if (left == wanted) return "";
  const std::string which = std::to_string(wanted) + " critical cells cannot be reached: ";
  if (level == 0) return which + "there are no more than " + std::to_string(left);
  if (level == levels && left > wanted)
    return which + std::to_string(left) + " are left by all cancellations";
  return which + "each cancellation takes two away, so that " + std::to_string(left) + " are left";
}

}  // namespace

std::vector<LevelSeed> levels_by_threshold(const FieldHierarchy& from,
                                           std::vector<persistence::Threshold> thresholds) {
  const auto value = [&](const persistence::Threshold& t) { return t.on(*from.field); };
  std::ranges::stable_sort(thresholds, {}, value);
  std::vector<LevelSeed> seeds;
  seeds.reserve(thresholds.size());
  for (const persistence::Threshold& threshold : thresholds)
    seeds.push_back(
        seed_of(from, from.hierarchy->level_above(value(threshold)), seeds.empty(),
                {.asked = to_string(threshold), .cancelled = CancelledLevel{.threshold = value(threshold)}}));
  return seeds;
}

std::vector<LevelSeed> levels_by_count(const FieldHierarchy& from, std::vector<std::size_t> counts) {
  const PersistenceHierarchy& hierarchy = *from.hierarchy;
  std::ranges::sort(counts, std::greater<>());
  std::vector<LevelSeed> seeds;
  seeds.reserve(counts.size());
  for (const std::size_t count : counts) {
    const Index level = hierarchy.level_with(count);
    seeds.push_back(
        seed_of(from, level, seeds.empty(),
                {.asked = std::to_string(count),
                 .cancelled = CancelledLevel{.count = count},
                 .note = note_on(count, critical_cells(hierarchy, level), level, hierarchy.levels())}));
  }
  return seeds;
}

}  // namespace morsel::tools
