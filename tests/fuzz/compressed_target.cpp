#include "morsel/core/error.h"
#include "morsel/core/io/file_content.h"
#include "target.h"

void morsel::fuzz::compressed(std::string_view bytes) {
  const core::Compression kind = core::compression_of(bytes);
  if (kind == core::Compression::none) return;
  constexpr core::DecompressionLimit kLimit{.least = std::size_t{1} << 20, .ratio = 64};
  try {
    const core::GrowingBytes content = core::decompress(bytes, kind, "fuzz", {}, kLimit);
    require(content.size() <= kLimit.for_size(bytes.size()), "more than the limit");
    const std::string twice = std::string(bytes) + std::string(bytes);
    const core::GrowingBytes both = core::decompress(twice, kind, "fuzz", {}, {});
    require(both.view() == std::string(content.view()) + std::string(content.view()), "members in a row");
  } catch (const core::BadInput& error) {
    require(std::string_view(error.what()).starts_with("cannot read \"fuzz\": its "), "a sentence");
  }
}
