#pragma once
/// Quadrangulation of a surface by a field: simplification, repair, layout, sampling and measurement.

#include <optional>
#include <string>

#include "morsel/mscomplex/quads.h"
#include "morsel/persistence/threshold.h"

namespace morsel::tools {

/// The Morse function of `morsel quads`, unless another is asked for.
inline constexpr const char* kQuadField = "eigenfunction:index=40";

/// A quadrangulation in the syntax of the command line.
struct QuadRequest {
  std::string
      persistence;  ///< "1%" or a number in the field's unit; empty: nothing is cancelled before the layout
  core::Index resolution = 10;
  int relaxation = 2;
};

/// A request whose values have been read.
struct QuadPlan {
  std::optional<persistence::Threshold> persistence;
  core::Index resolution = 0;
  int relaxation = 0;
};

/// Throws InvalidArgument on values out of range.
QuadPlan prepare(const QuadRequest& request);

struct Quadrangulation {
  double threshold = 0;       ///< of persistence, in the field's unit
  core::Index cancelled = 0;  ///< pairs of at most that
  mscomplex::RepairedComplex repaired;
  mscomplex::QuadLayout layout;
  mscomplex::QuadMesh mesh;
  mscomplex::QuadQuality quality;
  double layout_seconds = 0;
  double sampling_seconds = 0;
  double measuring_seconds = 0;
};

/// The quads are checked to be a manifold of the surface's Euler characteristic and boundary loops before
/// they are returned. Throws BadInput where the field gives no layout, and InvalidArgument for an odd
/// resolution on a bounded surface.
Quadrangulation quadrangulate(const core::ScalarField& field, const QuadPlan& plan,
                              const core::Progress& progress = {});

/// Patches at boundary loops, which have five sides.
core::Index boundary_patches(const mscomplex::MorseSmaleComplex& complex);

/// A summary as text: the cancelled pairs, the layout and the quality of the quads.
std::string described(const Quadrangulation& result, double diagonal);

}  // namespace morsel::tools
