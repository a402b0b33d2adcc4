#include <png.h>

#include <csetjmp>
#include <exception>
#include <new>

#include "morsel/tools/render/image.h"

namespace morsel::tools::render {
namespace {

/// Whether there was memory for it: exceptions must not pass through C.
bool append(std::string& bytes, const void* data, std::size_t size) noexcept {
  try {
    bytes.append(static_cast<const char*>(data), size);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

// libpng reports by longjmp, over which nothing with a destructor may be alive: so all that lives here is
// plain.
bool encode(const Image& image, bool opaque, std::string& bytes, png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, std::size_t size) {
        if (!append(*static_cast<std::string*>(png_get_io_ptr(writer)), data, size)) png_error(writer, "");
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.size.width),
               static_cast<png_uint_32>(image.size.height), 8,
               opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  if (opaque) png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (int y = 0; y < image.size.height; ++y) png_write_row(png, image.pixel(0, y));
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

std::string encode_png(const Image& image) {
  bool opaque = true;
  for (std::size_t i = 3; i < image.bytes.size(); i += 4) opaque = opaque && image.bytes[i] == 255;
  std::string bytes;
  // Without handlers it would print.
  png_structp png = png_create_write_struct(
      PNG_LIBPNG_VER_STRING, nullptr, [](png_structp writer, png_const_charp) { png_longjmp(writer, 1); },
      [](png_structp, png_const_charp) {});
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool done = info != nullptr && encode(image, opaque, bytes, png, info);
  png_destroy_write_struct(&png, &info);
  if (!done) throw std::bad_alloc();  // what else can go wrong in memory
  return bytes;
}

}  // namespace morsel::tools::render
