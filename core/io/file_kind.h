#pragma once
/// What a file is, by its content: for the sentences of readers that refuse it. Internal.

#include <string_view>

namespace morsel::core {

/// "gzip data", "a PDF document", "JSON", "an OBJ file", "UTF-16 text", as a sentence names it after "it is".
/// Empty if nothing is recognised. Looks at the first few kilobytes. What has no mark of its own (OBJ, PDB,
/// mmCIF, JSON) is recognised by its first line with a word.
std::string_view file_kind(std::string_view bytes);

}  // namespace morsel::core
