#pragma once
/// Lengths as users give them: in the unit of the mesh, or in ε.

#include <string>

#include "morsel/core/mesh.h"

namespace morsel::core {

/// A length in the unit of the mesh, or in ε = 0.3 % of the bounding box's diagonal (the paper's
/// "Parameters").
struct Length {
  double value = 0;
  bool in_epsilon = false;

  static constexpr Length absolute(double length) { return {length, false}; }
  static constexpr Length epsilons(double count) { return {count, true}; }

  /// The length in the unit of `mesh`.
  double on(const TriangleMesh& mesh) const { return in_epsilon ? value * mesh.epsilon() : value; }
};

/// "8eps" or "0.25"; parse_length() reads it back exactly.
std::string to_string(const Length& length);

}  // namespace morsel::core
