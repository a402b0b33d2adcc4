#pragma once
/// The descriptors of standard input, output and error.

namespace morsel::tools {

/// Occupies those of the three descriptors that are closed (`>&-`), so that no file which is opened later
/// gets the number of one, and with it what is printed. Reads and writes still fail as on a closed
/// descriptor. To be called before anything is opened. Throws std::system_error if there are no descriptors
/// left.
void occupy_standard_descriptors();

}  // namespace morsel::tools
