#include "morsel/tools/formats/base64.h"

#include "morsel/core/text/base64.h"

namespace morsel::tools {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void append_group(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::string& text) {
  const std::array<char, 4> digits = {kDigits[a >> 2], kDigits[(a & 3) << 4 | b >> 4],
                                      kDigits[(b & 15) << 2 | c >> 6], kDigits[c & 63]};
  text.append(digits.data(), digits.size());
}

}  // namespace

void Base64Encoder::encode(std::span<const std::byte> bytes, std::string& text) {
  const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  std::size_t i = 0;
  while (waiting_ > 0 && i < bytes.size()) {
    group_[waiting_++] = at(i++);
    if (waiting_ < 3) continue;
    append_group(group_[0], group_[1], group_[2], text);
    waiting_ = 0;
  }
  for (; i + 3 <= bytes.size(); i += 3) append_group(at(i), at(i + 1), at(i + 2), text);
  while (i < bytes.size()) group_[waiting_++] = at(i++);
}

void Base64Encoder::finish(std::string& text) {
  if (waiting_ == 0) return;
  append_group(group_[0], waiting_ == 2 ? group_[1] : 0, 0, text);
  text.replace(text.size() - (3 - waiting_), 3 - waiting_, 3 - waiting_, '=');
  waiting_ = 0;
}

std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  Base64Encoder encoder;
  encoder.encode(std::as_bytes(std::span(bytes)), text);
  encoder.finish(text);
  return text;
}

std::optional<std::string> decoded_base64(std::string_view text) {
  constexpr std::string_view kAll = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=";
  text = text.substr(0, text.find_first_not_of(kAll));
  std::size_t digits = text.find('=');
  if (digits == std::string_view::npos) digits = text.size();
  if (text.size() % 4 != 0 || text.size() - digits > 2 ||
      text.find_first_not_of('=', digits) != std::string_view::npos)
    return std::nullopt;
  return core::decode_base64(text);
}

}  // namespace morsel::tools
