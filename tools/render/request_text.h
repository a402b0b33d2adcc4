#pragma once
/// Requests for pictures in the syntax of the command line.

#include <cstdint>
#include <string>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/render/picture.h"

namespace morsel::tools::render {

/// "1200x900"; throws InvalidArgument on anything else and on sizes that check_size() refuses.
Size parse_size(const std::string& text);

/// "VERTEX" or "VERTEX:RADIUS", the vertex by its number in the input file, not yet looked up.
struct InsetText {
  std::int64_t vertex = 0;
  core::Length radius = Inset{}.radius;
};
InsetText parse_inset(const std::string& text);
/// Throws InvalidArgument if the input has no such vertex, or repair dropped it.
Inset find_inset(const InsetText& text, const core::LoadedMesh& loaded);

/// The camera's position, and a region to magnify.
struct CameraText {
  std::string view = "best";
  UpAxis up = UpAxis::y;
  std::string inset;  ///< none if empty

  /// Throws InvalidArgument on an unknown view and a malformed inset.
  void check() const;
};

/// The settings of a comparison's pictures.
struct FigureText {
  std::string size = "1200x840";
  CameraText camera;

  /// Throws InvalidArgument, too, on a size that parse_size() refuses.
  void check() const;
};

/// "field", "descending", "ascending", "morse-smale", "plain"
std::string to_string(Show show);
/// "automatic", "zero", "median", "none"
std::string to_string(ScaleRequest::Center center);

/// All settings that determine a picture besides the subject, vertices by their numbers in the input file.
/// `caption`: as it is drawn.
Json picture_section(const PictureRequest& request, const CameraText& camera, const std::string& caption,
                     const core::VertexNumbering& numbering);

}  // namespace morsel::tools::render
