#pragma once
/// The page that shows a collection.

#include <string>
#include <vector>

#include "morsel/tools/batch/batch.h"
#include "morsel/tools/batch/summary.h"
#include "morsel/tools/formats/embedded_text.h"

namespace morsel::tools::batch {

/// Writes plots/histogram.svg, cumulative.svg and against-size.svg (unless no mesh is done) and index.html:
/// the plots, and a table of the meshes with their pictures, sorted by a click on a column's head, that needs
/// nothing but the folder. Throws WriteFailed.
void write_page(const std::vector<MeshOutcome>& outcomes, const BatchRequest& request,
                const SummaryOptions& options, ResultFolder& out);

/// The page's style sheet and script, as the build embeds them (html/embed.cmake).
extern const EmbeddedText kPageStyle;
extern const EmbeddedText kPageScript;

}  // namespace morsel::tools::batch
