#pragma once
/// Makes one figure: its panels, each equal to that of `morsel render`, and the sheet that shows them side by
/// side.

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/reproduce/outcome.h"
#include "morsel/tools/results/result_folder.h"

namespace morsel::tools::reproduce {

/// What all panels of a figure have in common.
struct PictureOptions {
  render::Size size{800, 680};  ///< of a panel
  int samples = 16;             ///< a pixel
  render::CameraText camera;    ///< its inset is not used
  core::BuildOptions build;     ///< included in the commands
};

/// Writes figureN.png and, as figureNa.png, figureNb.png …, its panels into `folder`. Throws what methods,
/// pictures and files throw. `provenance`: of the figure, without field and methods; each panel has its own.
FigureOutcome make_figure(const FigureRecipe& recipe, Model& model, const PictureOptions& options,
                          ResultFolder& folder, Provenance provenance, const core::Progress& progress = {});

}  // namespace morsel::tools::reproduce
