#pragma once
/// The folder that files are exported to.

#include <filesystem>

namespace morsel::tools {

/// Makes the folder, and those it is in, if it is not there. Throws WriteFailed if that cannot be done.
void make_folder(const std::filesystem::path& folder);

}  // namespace morsel::tools
