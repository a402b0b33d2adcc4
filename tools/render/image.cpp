#include "morsel/tools/render/image.h"

#include "morsel/core/error.h"

namespace morsel::tools::render {

void check_size(Size size) {
  const auto in_range = [](int side) { return side >= 1 && side <= kLargestSide; };
  if (!in_range(size.width) || !in_range(size.height) || std::int64_t{size.width} * size.height > 100'000'000)
    throw core::InvalidArgument("a picture of " + std::to_string(size.width) + "x" +
                                std::to_string(size.height) + " pixels cannot be made: each side is 1 to " +
                                std::to_string(kLargestSide) + ", and no more than 100 million in all");
}

Image::Image(Size s, bool transparent) : size(s) {
  check_size(s);
  bytes.assign(4 * static_cast<std::size_t>(s.width) * s.height, transparent ? 0 : 255);
}

}  // namespace morsel::tools::render
