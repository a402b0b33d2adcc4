#pragma once
/// A region of a picture magnified: in one of its corners, or as a picture of its own.

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/render/canvas.h"
#include "morsel/tools/render/tracer.h"

namespace morsel::tools::render {

/// The part of the film that shows, in a picture of the film's shape, what lies within `radius` (in the
/// body's unit) of `center`, and more along the longer side. Throws InvalidArgument on a radius out of range.
FilmWindow window_around(const Camera& camera, const core::Point& center, double radius);

/// Frames a window in a picture of all the film.
void draw_window(Canvas& canvas, Size picture, const FilmWindow& window, double em);

/// Traces what lies within `radius` (in the body's unit, above 0) of `center`, seen by the same camera, and
/// draws it, framed, in the corner where it hides least of `picture`, which is on the canvas at (0, 0). Two
/// lines lead to a frame around the region. Throws InvalidArgument on a radius out of range.
void draw_inset(Canvas& canvas, const Image& picture, const Tracer& tracer, const Camera& camera,
                const TraceOptions& options, const core::Point& center, double radius, double em,
                const core::Progress& progress = {});

}  // namespace morsel::tools::render
