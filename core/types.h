#pragma once
/// The small types that every module uses.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace morsel::core {

/// Number of a vertex, edge, half-edge, triangle, loop or component: 0 … count − 1.
using Index = std::uint32_t;

/// "None": no twin, no such vertex. Never a valid number.
inline constexpr Index kNone = 0xFFFF'FFFFu;

/// A position in ℝ³, in double precision and in the unit of the input file.
using Point = Eigen::Vector3d;

/// Three vertex numbers, counter-clockwise when seen from outside.
using Triangle = std::array<Index, 3>;

}  // namespace morsel::core
