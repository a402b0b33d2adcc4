#pragma once
/// Threads that can be made, and what oneTBB needs when it makes them.

namespace morsel::tools {

/// The number of threads, at most `wanted` (≥ 1), this one among them, that there can be now: made and ended
/// to find it out. oneTBB, of which every thread that it takes for possible must be made, would end the
/// process.
int possible_threads(int wanted);

/// Takes the memory that a failing dlopen() on this thread needs, once. oneTBB looks for optional libraries
/// when it starts: where memory is short at the first that is missing, glibc 2.36 reads a wild pointer at the
/// second. Throws std::bad_alloc.
void prepare_failing_dlopen();

}  // namespace morsel::tools
