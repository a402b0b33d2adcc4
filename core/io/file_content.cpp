#include "morsel/core/io/file_content.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <utility>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {

Compression compression_of(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.size() < 4) return Compression::none;
  if (bytes.starts_with("\x1F\x8B"sv)) return Compression::gzip;
  if (bytes.starts_with("\xFD"
                        "7zXZ\0"sv))
    return Compression::xz;
  const bool skippable = bytes.substr(1).starts_with("\x2A\x4D\x18"sv) && (bytes[0] & 0xF0) == 0x50;
  if (bytes.starts_with("\x28\xB5\x2F\xFD"sv) || skippable) return Compression::zstd;
  return Compression::none;
}

void DecompressionBudget::take(std::uint64_t count, std::uint64_t size, const std::string& file,
                               const std::string& what) {
  if (size != 0 && count > left_ / size)
    fail_reading(file, "its data expand to more than " + std::to_string(most_ >> 20) + " MiB, over " +
                           std::to_string(most_ / std::max<std::size_t>(file_size_, 1)) +
                           " times its size, at " + what +
                           ", which is refused: write it without compression if that is meant");
  left_ -= static_cast<std::size_t>(count * size);
}

char* GrowingBytes::room_for(std::size_t more) {
  if (capacity_ - size_ < more) {
    const std::size_t capacity = std::max(size_ + more, capacity_ + capacity_ / 2);
    auto* const moved = static_cast<char*>(std::realloc(bytes_.get(), capacity));
    if (moved == nullptr) throw std::bad_alloc();
    static_cast<void>(bytes_.release());
    bytes_.reset(moved);
    capacity_ = capacity;
  }
  return bytes_.get() + size_;
}

std::string content_extension(const std::filesystem::path& path) {
  const std::string extension = file_extension(path);
  constexpr std::array<std::string_view, 3> kCompressed = {".gz", ".xz", ".zst"};
  return std::ranges::find(kCompressed, extension) == kCompressed.end() ? extension
                                                                        : file_extension(path.stem());
}

DecodedBytes::DecodedBytes(std::string_view bytes, const std::string& name, const Progress& progress)
    : plain_(bytes) {
  const Compression kind = compression_of(bytes);
  if (kind != Compression::none) decompressed_ = decompress(bytes, kind, name, progress);
}

namespace {

bool is_little_endian(std::string_view bytes) { return bytes.starts_with("\xFF\xFE"); }

std::uint32_t unit_at(std::string_view bytes, std::size_t i, bool little) {
  const auto low = static_cast<unsigned char>(bytes[i + (little ? 0 : 1)]);
  const auto high = static_cast<unsigned char>(bytes[i + (little ? 1 : 0)]);
  return static_cast<std::uint32_t>(high << 8 | low);
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto continuation = [](std::uint32_t bits) { return static_cast<char>(0x80 | (bits & 0x3F)); };
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | code >> 6);
    text += continuation(code);
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0 | code >> 12);
    text += continuation(code >> 6);
    text += continuation(code);
  } else {
    text += static_cast<char>(0xF0 | code >> 18);
    text += continuation(code >> 12);
    text += continuation(code >> 6);
    text += continuation(code);
  }
}

}  // namespace

bool is_utf16(std::string_view bytes) {
  const bool little = is_little_endian(bytes);
  if (bytes.size() < 4 || !(little || bytes.starts_with("\xFE\xFF"))) return false;
  const std::uint32_t first = unit_at(bytes, 2, little);
  return (first >= '\t' && first <= '\r') || (first >= ' ' && first <= '~');
}

std::string utf8_of_utf16(std::string_view bytes, const std::string& name) {
  const bool little = is_little_endian(bytes);
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 2; i < bytes.size(); i += 2) {
    if (bytes.size() - i < 2) fail_reading(name, "it is UTF-16 text that ends within a character");
    std::uint32_t code = unit_at(bytes, i, little);
    if (code >= 0xD800 && code < 0xE000) {
      const std::uint32_t low = code < 0xDC00 && bytes.size() - i >= 4 ? unit_at(bytes, i + 2, little) : 0;
      if (low < 0xDC00 || low >= 0xE000)
        fail_reading(name, "it is UTF-16 text with half a character at byte " + std::to_string(i));
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
      i += 2;
    }
    append_utf8(text, code);
  }
  return text;
}

TextContent::TextContent(const std::filesystem::path& path, const std::string& name, const Progress& progress)
    : bytes_(std::in_place, path, name), decoded_(bytes_->view(), name, progress), text_(decoded_.view()) {
  convert(name);
}

TextContent::TextContent(std::string_view bytes, const std::string& name, const Progress& progress)
    : decoded_(bytes, name, progress), text_(decoded_.view()) {
  convert(name);
}

void TextContent::convert(const std::string& name) {
  if (is_utf16(text_)) {
    converted_ = utf8_of_utf16(text_, name);
    text_ = converted_;
    warnings_.emplace_back(kUtf16Warning);
  }
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // a byte-order mark
  if (text_.find('\n') == std::string_view::npos && text_.find('\r') != std::string_view::npos) {
    std::string lines(text_);
    std::ranges::replace(lines, '\r', '\n');
    converted_ = std::move(lines);
    text_ = converted_;
  }
}

}  // namespace morsel::core
