#pragma once
/// Cutting a surface open, as `morsel cut` does between reading a mesh and writing files.

#include <cstddef>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/cut.h"

namespace morsel::tools {

/// The Morse function of `morsel cut`, unless another is asked for.
inline constexpr const char* kCutField = "height:axis=z";

/// One component of a surface and its cut. Lengths in the mesh's unit.
struct ComponentCut {
  core::Index vertices = 0;
  core::Index genus = 0;
  core::Index loops = 0;  ///< of its boundary
  std::size_t paths = 0;
  double length_found = 0;  ///< of the cut made of arcs
  double length = 0;        ///< after shortening
  std::size_t copies = 0;   ///< of vertices, that the cut makes
};

/// A surface cut open.
struct CutOutcome {
  mscomplex::CutGraph cut;
  double length_found = 0;
  std::size_t attempts = 0;  ///< of shortening
  std::size_t replaced = 0;
  bool is_settled = false;
  mscomplex::CutMesh opened;
  std::vector<ComponentCut> components;
  double complex_seconds = 0, cut_seconds = 0, shorten_seconds = 0, open_seconds = 0;
};

/// Makes the field's complex, cuts along it, shortens the cut if wanted and opens the mesh.
CutOutcome cut_surface(const core::ScalarField& field, bool shorten, const core::Progress& progress = {});

}  // namespace morsel::tools
