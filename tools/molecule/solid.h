#pragma once
/// The solid within a molecular surface, as a function that is negative inside. Internal.

#include <memory>
#include <span>
#include <vector>

#include "morsel/core/io/molecule.h"
#include "morsel/core/types.h"

namespace morsel::tools {

/// An atom as geometry.
struct Ball {
  core::Point center;
  double radius;
};

/// A solid given by a continuous function: negative inside, positive outside, and close to its surface about
/// the distance to it in Å, so that the surface may be interpolated linearly. Immutable; may be evaluated
/// from any number of threads.
class Solid {
 public:
  virtual ~Solid() = default;

  /// Points farther than this from the centers of all balls are outside.
  virtual double reach() const = 0;

  /// Balls whose centers are farther from a place do not change the function there; at least reach().
  virtual double influence() const { return reach(); }

  /// The function at `places`, given the numbers (ascending) of all balls whose centers lie within
  /// influence() of one of them, and perhaps of others. `values` has as many elements.
  virtual void evaluate(std::span<const core::Point> places, std::span<const core::Index> balls,
                        std::span<double> values) const = 0;
};

/// The union of the balls: min_i (‖x − c_i‖ − r_i), exactly the distance outside.
std::unique_ptr<Solid> ball_solid(std::vector<Ball> balls);

/// Where Σ_i exp(B (1 − ‖x − c_i‖² / r_i²)) ≥ 1. Terms below 10⁻⁷ are left out.
std::unique_ptr<Solid> gaussian_solid(std::vector<Ball> balls, double blobbiness);

/// The solvent-excluded solid (Richards 1977, Connolly 1983): what no ball of radius `probe` > 0 that stays
/// outside all balls can touch. Its function is probe − d, with d the distance to the places where the
/// probe's center may be: exact from −depth up, and −depth wherever it would be less. Throws BadInput where
/// more than 2²⁵ pairs of balls, and 128 for each, can be touched at once.
std::unique_ptr<Solid> excluded_solid(std::vector<Ball> balls, double probe, double depth);

}  // namespace morsel::tools
