#pragma once
/// The stack that the program works on.

#include <functional>

namespace morsel::tools {

/// Runs work(), which must not throw, with a stack of at least 8 MiB, the usual limit of systems: on this
/// thread or, if the limit is smaller (`ulimit -s`), on one of its own, for which this one waits. Eigen's
/// dense solvers alone have temporaries of 128 KiB each on the stack. If no thread can be made, on this one.
/// The worker threads of oneTBB have 4 MiB whatever the limit is.
void with_enough_stack(const std::function<void()>& work);

}  // namespace morsel::tools
