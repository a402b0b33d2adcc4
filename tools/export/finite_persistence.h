#pragma once
/// Persistence as numbers that other programs can colour and threshold by.

#include <cstdint>
#include <span>
#include <vector>

namespace morsel::tools {

/// ParaView and MeshLab show nothing of an array with infinite numbers: in place of an infinite persistence
/// stands the extent of the field, which no finite one exceeds, and a flag tells the two apart.
struct FinitePersistence {
  std::vector<double> values;
  std::vector<std::uint8_t> essential;  ///< 1 where the persistence is infinite, else 0

  void add(double persistence, double extent);
};

FinitePersistence finite_persistence(std::span<const double> persistence, double extent);

}  // namespace morsel::tools
