#pragma once
/// How an error that nothing else handles is reported: one sentence on standard error and an exit code.

namespace morsel::tools {

/// To be called in a handler (catch): tells the exception that is being handled as `morsel: SENTENCE` and
/// returns its exit code (commands.h). Needs no memory. An exception that no rule names is a defect of the
/// program, and is told so. After a signal everything is taken for its consequence.
int tell_failure() noexcept;

/// Exceptions and crashes in the static initialisation of libraries, before main(), end the process in the
/// same way. To be called when main() begins: from here on a crash is the program's own.
void begin_main() noexcept;

/// Tells a sentence, by the system's own call.
void tell(const char* sentence, const char* rest = "") noexcept;

/// Whether operator new has failed in this process, or would fail now. Async-signal-safe.
bool memory_has_run_out() noexcept;
/// Ends the process with the exit code and sentence for that. Async-signal-safe.
[[noreturn]] void end_out_of_memory() noexcept;

}  // namespace morsel::tools
