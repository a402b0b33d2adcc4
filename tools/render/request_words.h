#pragma once
/// Requests of pictures as the words of the command line that make them again; see report/request_words.h.

#include <string>
#include <vector>

#include "morsel/tools/render/request_text.h"

namespace morsel::tools::render {

/// --view, --up, --size and --inset of a comparison's pictures.
std::vector<std::string> words_of(const FigureText& figure);
/// The same where there are small pictures alone, which have neither --size nor --inset.
std::vector<std::string> words_of_thumbnails(const CameraText& camera);
/// The options of `morsel render` about the picture; regions by the vertices' numbers in the input file.
/// `camera`: its inset is not used, since the request has it. `caption`: as --caption has it.
std::vector<std::string> words_of(const PictureRequest& request, const CameraText& camera,
                                  const std::string& caption, const core::VertexNumbering& numbering);

}  // namespace morsel::tools::render
