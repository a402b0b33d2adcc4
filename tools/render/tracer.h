#pragma once
/// Renders a scene by ray tracing.

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/render/camera.h"
#include "morsel/tools/render/image.h"
#include "morsel/tools/render/scene.h"

namespace morsel::tools::render {

/// The part of the film that a picture shows: from (x0, y0), below on the left, to (x1, y1).
struct FilmWindow {
  double x0 = -1;
  double y0 = -1;
  double x1 = 1;
  double y1 = 1;
};

struct TraceOptions {
  Size size;
  int samples = 16;          ///< a pixel, 1 … 1024
  bool transparent = false;  ///< else white where nothing is
  bool shaded = true;        ///< else every colour as it is
  FilmWindow window;
};

/// A scene prepared for ray tracing. Refers to the scene.
class Tracer {
 public:
  explicit Tracer(const Scene& scene);

  /// Smooth-shaded under a wide sky (ambient occlusion that fades out at 0.3 of the diagonal) and a soft lamp
  /// above on the left of the camera. A pixel whose first quarter of samples (four or more) all show one
  /// piece of surface of one colour is not sampled further, and its light is averaged with that of such
  /// neighbours in its plane; any other gets all samples. Samples are laid out evenly in every pixel, and
  /// rays over blocks of pixels, by an additive recurrence (Roberts 2018): the same bytes for every number of
  /// threads. Parallel. 64 bytes a pixel. Throws InvalidArgument on options out of range.
  Image trace(const Camera& camera, const TraceOptions& options, const core::Progress& progress = {}) const;

  const Rays& rays() const { return rays_; }

 private:
  const Scene& scene_;
  Rays rays_;
};

}  // namespace morsel::tools::render
