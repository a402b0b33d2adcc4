#pragma once
/// A picture of a surface, its field and its critical points: what `morsel render` and `morsel compare
/// --figures` make.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/mesh/length.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/segmentation.h"
#include "morsel/tools/color/value_scale.h"
#include "morsel/tools/render/body.h"
#include "morsel/tools/render/camera.h"
#include "morsel/tools/render/image.h"
#include "morsel/tools/render/legend.h"
#include "morsel/tools/render/rays.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools::render {

/// What the surface is coloured by.
enum class Show { field, descending, ascending, morse_smale, plain };
/// The kind of segments that is shown, if segments are.
std::optional<mscomplex::SegmentKind> segments_of(Show show);

/// A region around a vertex that is shown magnified.
struct Inset {
  core::Index vertex = core::kNone;  ///< the mesh's number
  core::Length radius = core::Length::epsilons(15);
};

struct PictureRequest {
  Size size;
  int samples = 16;  ///< a pixel
  bool transparent = false;
  Show show = Show::field;
  bool points = true;
  bool arcs = false;
  ScaleRequest scale;
  bool legend =
      true;  ///< a colour bar where the surface shows the field; left out of pictures under 240 x 160
  std::optional<Inset> inset;     ///< shown magnified in a corner
  std::optional<Inset> frame;     ///< framed, as the region of another picture's close-up
  std::optional<Inset> close_up;  ///< fills the picture, seen by the camera that would show all
};

/// The content of a picture.
struct Subject {
  const core::ScalarField& field;
  const Measurement* measurement = nullptr;  ///< must be there for points, arcs and segments
  Quantity quantity;
  std::string caption;                       ///< lines; none if empty
  std::span<const core::Index> places = {};  ///< for each point, the vertex to show it at; empty: its own
  const morse::CriticalPoints* points = nullptr;  ///< to show; null: the measurement's
};

/// What a picture of a method shows: chosen points where there are such. `field_name` and `unit`: of the
/// field before the method. Refers to the outcome.
Subject subject_of(const MethodOutcome& outcome, const std::string& field_name, const std::string& unit);

/// One surface from one side, for any number of pictures. Holds the mesh by value.
class Studio {
 public:
  explicit Studio(const core::TriangleMesh& mesh);

  /// "best", or what named_view() takes.
  View view(const std::string& name, UpAxis up = UpAxis::y, const core::Progress& progress = {}) const;

  /// For each vertex, whether a square picture shows it: it faces the camera, the cosine being at least
  /// `least_cosine`, and is not occluded. Parallel.
  std::vector<bool> shown(const View& view, double least_cosine) const;

  /// Throws InvalidArgument on options out of range, a subject of another mesh, or one without a measurement
  /// where it is needed. The same bytes for every number of threads.
  Image take(const View& view, const Subject& subject, const PictureRequest& request,
             const core::Progress& progress = {}) const;

 private:
  Body body_;
  Rays rays_;    // of the body alone
  double unit_;  // the mesh's diagonal: a length of 1 of the body
  core::TriangleMesh mesh_;
};

}  // namespace morsel::tools::render
