#pragma once
/// Which vector instructions the processor has.

#include <cstdint>
#include <string_view>
#include <vector>

namespace morsel::morse {

/// The instruction sets that there are kernels for, in one binary; which one runs is chosen at run time.
enum class InstructionSet : std::uint8_t {
  baseline,  ///< plain C++: what every processor of the architecture has (SSE2 on x86-64)
  avx2,      ///< AVX2 and FMA
  avx512     ///< AVX-512 F, DQ, BW, VL
};

/// "baseline", "avx2", "avx512".
std::string_view to_string(InstructionSet set);
/// Those that run on this processor (and that the binary has), slowest first; never empty.
std::vector<InstructionSet> instruction_sets();
/// The fastest of them.
InstructionSet best_instruction_set();

}  // namespace morsel::morse
