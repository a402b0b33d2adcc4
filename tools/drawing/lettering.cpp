#include "morsel/tools/drawing/lettering.h"

#include <cairo-ft.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "morsel/core/error.h"
#include "morsel/tools/drawing/font.h"
#include "morsel/tools/drawing/pictures.h"

namespace morsel::tools::drawing {
namespace {

/// The number of bytes of the character that text[i] begins, 0 if it is none.
std::size_t character_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char head = byte(i);
  if (head < 0x20 || head == 0x7f) return 0;
  if (head < 0x80) return 1;
  const std::size_t length = head < 0xc2 ? 0 : head < 0xe0 ? 2 : head < 0xf0 ? 3 : head < 0xf5 ? 4 : 0;
  if (length == 0 || i + length > text.size()) return 0;
  std::uint32_t code = head & (0x7fU >> length);
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xc0U) != 0x80) return 0;
    code = code << 6 | (byte(i + k) & 0x3fU);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0xa0, 0x800, 0x10000};  // 0x80 to 0x9f are control characters
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  const bool character =
      code >= kLeast[length] && code <= 0x10ffff && !surrogate && (code & 0xfffeU) != 0xfffeU;
  return character ? length : 0;
}

/// A FreeType face and the library that it lives in.
struct Face {
  std::string bytes;  // of which FreeType has no copy
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  ~Face() {
    if (library != nullptr) FT_Done_FreeType(library);  // and its faces
  }
};

cairo_font_face_t* make_font() {
  auto holder = std::make_unique<Face>();
  for (const std::string_view piece : kFontPieces) holder->bytes += piece;
  if (FT_Init_FreeType(&holder->library) != 0 ||
      FT_New_Memory_Face(holder->library, reinterpret_cast<const FT_Byte*>(holder->bytes.data()),
                         static_cast<FT_Long>(holder->bytes.size()), 0, &holder->face) != 0)
    throw std::bad_alloc();
  cairo_font_face_t* font = cairo_ft_font_face_create_for_ft_face(holder->face, 0);
  // cairo keeps a font for a while after its last use; the face is freed when cairo frees the font.
  static const cairo_user_data_key_t key{};
  if (cairo_font_face_set_user_data(font, &key, holder.get(), [](void* face) {
        delete static_cast<Face*>(face);
      }) != CAIRO_STATUS_SUCCESS) {
    cairo_font_face_destroy(font);
    throw std::bad_alloc();
  }
  static_cast<void>(holder.release());
  return font;
}

}  // namespace

bool has_pictures() { return true; }

void check_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0)
      throw core::InvalidArgument("byte " + std::to_string(i) +
                                  " of a text to be drawn is not UTF-8, or a control character");
    i += length;
  }
}

Lettering::Lettering() {
  cairo_font_face_t* font = make_font();
  surface_ = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr);
  context_ = cairo_create(surface_);
  cairo_set_font_face(context_, font);
  cairo_font_face_destroy(font);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_, options);
  cairo_font_options_destroy(options);
  if (cairo_status(context_) != CAIRO_STATUS_SUCCESS) {
    cairo_destroy(context_);
    cairo_surface_destroy(surface_);
    throw std::bad_alloc();
  }
}

Lettering::~Lettering() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

double Lettering::width(std::string_view text, double size) {
  check_text(text);
  constexpr double kMeasured = 1000;  // so that nothing depends on how sizes are rounded
  cairo_set_font_size(context_, kMeasured);
  cairo_text_extents_t extents;
  cairo_text_extents(context_, std::string(text).c_str(), &extents);
  if (cairo_status(context_) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();  // the width would be 0
  return extents.x_advance * size / kMeasured;
}

std::string Lettering::shortened(std::string_view text, double size, double limit) {
  if (width(text, size) <= limit) return std::string(text);
  constexpr const char* kEllipsis = "\u2026";
  std::string result = kEllipsis;
  for (std::size_t end = 0; end < text.size();) {
    end += character_length(text, end);
    std::string longer = std::string(text.substr(0, end)) + kEllipsis;
    if (width(longer, size) > limit) break;
    result = std::move(longer);
  }
  return result;
}

void Lettering::use(cairo_t* context, double size) {
  cairo_set_font_face(context, cairo_get_font_face(context_));
  cairo_font_options_t* options = cairo_font_options_create();
  if (cairo_font_options_status(options) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  cairo_get_font_options(context_, options);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
  cairo_set_font_size(context, size);
}

}  // namespace morsel::tools::drawing
