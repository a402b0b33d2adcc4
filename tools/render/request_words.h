#pragma once
/// Requests as the words of the command line that make them again. Every command that shows, runs or records
/// a command line has its words from here; for each option of the tables that shapes a result, a test
/// (tests/commands) checks that the words have it.

#include <string>
#include <vector>

#include "morsel/tools/render/request_text.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools::render {

/// --field, --method, --target, --snap, --repair and the options of chosen points of the commands that run
/// several methods.
std::vector<std::string> words_of(const ComparisonRequest& request, bool repair);
/// --field, --method, --target and --repair of the commands on one field.
std::vector<std::string> words_of(const FieldRequest& request, bool repair);
/// --view, --up, --size and --inset of a comparison's pictures.
std::vector<std::string> words_of(const FigureText& figure);
/// The same where there are small pictures alone, which have neither --size nor --inset.
std::vector<std::string> words_of_thumbnails(const CameraText& camera);
/// The options of `morsel render` about the picture; regions by the vertices' numbers in the input file.
/// `camera`: its inset is not used, since the request has it. `caption`: as --caption has it.
std::vector<std::string> words_of(const PictureRequest& request, const CameraText& camera,
                                  const std::string& caption, const core::VertexNumbering& numbering);

}  // namespace morsel::tools::render
