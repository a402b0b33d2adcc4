// What libFuzzer calls; MORSEL_FUZZ_TARGET is one of the functions in target.h. An exception that leaves it
// ends the process, which libFuzzer reports with the input.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  morsel::fuzz::MORSEL_FUZZ_TARGET(std::string_view(reinterpret_cast<const char*>(data), size));
  return 0;
}
