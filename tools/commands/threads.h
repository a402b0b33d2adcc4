#pragma once
/// How many threads the system lets this process have.

namespace morsel::tools {

/// The number of threads, at most `wanted` (≥ 1), this one among them, that there can be now: made and ended
/// to find it out. oneTBB, of which every thread that it takes for possible must be made, would end the
/// process.
int possible_threads(int wanted);

}  // namespace morsel::tools
