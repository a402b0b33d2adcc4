#pragma once
/// Reading a text of lines in parallel: what the readers of text formats share. Internal.

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// Cuts a text into pieces of whole lines, each of `chunk` bytes or a line more. No pieces where that is
/// not worth it: the text is shorter than two of them, or there is one thread; nor where a piece would begin
/// with a byte-order mark, which readers skip.
std::vector<std::string_view> line_chunks(std::string_view text, char terminator, std::size_t chunk);

/// The number of items (such as lines) in each chunk, and the number of those before it; one entry more than
/// chunks, which is the sum. Checks for cancellation.
std::vector<std::size_t> items_before(const std::vector<std::string_view>& chunks,
                                      const std::function<std::size_t(std::string_view)>& count,
                                      const Progress& progress);

/// Reads chunk after chunk with `read`, in parallel, and joins the soups in their order. Returns nothing if
/// one of them threw BadInput: then the text must be read from its start, so that the error is the first one
/// and names its line. Reports progress and checks for cancellation.
std::optional<PolygonSoup> read_chunks(std::size_t chunks,
                                       const std::function<PolygonSoup(std::size_t)>& read,
                                       const Progress& progress);

}  // namespace morsel::core
