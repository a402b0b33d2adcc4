#include "morsel/tools/formats/png_comment.h"

#include <zlib.h>

#include <cstdint>

#include "morsel/tools/formats/version.h"

namespace morsel::tools::drawing {
namespace {

void append_number(std::string& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
}

/// A tEXt chunk: length, kind, keyword and text, checksum.
std::string text_chunk(std::string_view keyword, std::string_view text) {
  std::string body = "tEXt" + std::string(keyword);
  body += '\0';
  body += text;
  std::string chunk;
  append_number(chunk, static_cast<std::uint32_t>(body.size() - 4));
  chunk += body;
  append_number(chunk, static_cast<std::uint32_t>(
                           crc32_z(0, reinterpret_cast<const unsigned char*>(body.data()), body.size())));
  return chunk;
}

}  // namespace

std::string with_png_comment(std::string png, std::string_view comment) {
  constexpr std::size_t kHead = 8 + 25;  // the signature and the first chunk, IHDR, which is always that long
  if (!comment.empty())
    png.insert(kHead,
               text_chunk("Software", std::string("morsel ") + kVersion) + text_chunk("Comment", comment));
  return png;
}

}  // namespace morsel::tools::drawing
