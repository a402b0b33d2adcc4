#include "morsel/morse/smoothing/pair_kernels.h"

namespace morsel::morse {

const PairKernels& pair_kernels(InstructionSet set) {
#ifdef MORSEL_X86_KERNELS
  if (set == InstructionSet::avx512) return kAvx512Kernels;
  if (set == InstructionSet::avx2) return kAvx2Kernels;
#endif
  (void)set;
  return kBaselineKernels;
}

}  // namespace morsel::morse
