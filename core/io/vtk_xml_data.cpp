#include "morsel/core/io/vtk_xml_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "morsel/core/text/text_scanner.h"

namespace morsel::core::vtk {
namespace {

constexpr std::string_view kXmlSpace = " \t\r\n";

/// The six bits of a character of base64; −1 of any other.
constexpr std::array<signed char, 256> base64_bits() {
  std::array<signed char, 256> bits{};
  bits.fill(-1);
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    bits[static_cast<unsigned char>(kDigits[i])] = static_cast<signed char>(i);
  return bits;
}
constexpr std::array<signed char, 256> kBits = base64_bits();

/// One byte of deflated data makes at most that many.
constexpr std::uint64_t kMostDeflated = 1032;

class BlockReader {
 public:
  BlockReader(ByteStream& stream, const XmlEncoding& encoding, const std::string& file,
              const std::string& what, const std::function<void(std::uint64_t)>& check,
              const Progress& progress)
      : stream_(stream), encoding_(encoding), file_(file), what_(what), check_(check), progress_(progress) {}

  std::string plain() {
    const std::uint64_t length = word();
    if (length > stream_.room())
      fail("is said to have " + std::to_string(length) + " bytes, but the file is too short for them");
    check_(length);
    std::string result;
    result.reserve(length);
    constexpr std::uint64_t kPart = std::uint64_t{1} << 24;
    for (std::uint64_t left = length; left > 0; left -= std::min(left, kPart)) {
      progress_.throw_if_cancelled();
      if (!stream_.read(std::min(left, kPart), result)) fail_short();
    }
    return result;
  }

  std::string inflated() {
    const std::uint64_t blocks = word();
    if (blocks == 0) return {};
    const std::uint64_t size = word();
    const std::uint64_t last = word();
    const std::size_t width = encoding_.wide_header ? 8 : 4;
    if (blocks > stream_.room() / width)
      fail("is said to have " + std::to_string(blocks) + " blocks, but the file is too short for them");
    std::vector<std::uint64_t> lengths(blocks);
    for (std::uint64_t& length : lengths) length = word();
    const std::uint64_t ending = last > 0 ? last : size;
    if (size > (std::numeric_limits<std::uint64_t>::max() - ending) / blocks)
      fail("is said to have " + std::to_string(blocks) + " blocks of " + std::to_string(size) + " bytes");
    check_(size * (blocks - 1) + ending);
    std::string result;
    std::string deflated;
    for (std::size_t i = 0; i < blocks; ++i) {
      progress_.throw_if_cancelled();
      const std::uint64_t expected = i + 1 == blocks ? ending : size;
      if (lengths[i] > stream_.room() || expected / kMostDeflated > lengths[i])
        fail("is said to have a block of " + std::to_string(expected) + " bytes compressed to " +
             std::to_string(lengths[i]) + ", for which the file is too short");
      deflated.clear();
      if (!stream_.read(lengths[i], deflated)) fail_short();
      const std::size_t begin = result.size();
      result.resize(begin + expected);
      uLongf got = expected;
      const int status = ::uncompress(reinterpret_cast<Bytef*>(result.data() + begin), &got,
                                      reinterpret_cast<const Bytef*>(deflated.data()), deflated.size());
      if (status != Z_OK || got != expected)
        fail("is damaged: zlib cannot read its block " + std::to_string(i));
    }
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_reading(file_, what_ + " " + what); }
  [[noreturn]] void fail_short() const { fail("is cut off or is no base64"); }

  std::string bytes(std::uint64_t count) {
    std::string result;
    if (!stream_.read(count, result)) fail_short();
    return result;
  }
  std::uint64_t word() {
    std::string text = bytes(encoding_.wide_header ? 8 : 4);
    if (encoding_.swap) std::reverse(text.begin(), text.end());
    if (encoding_.wide_header) {
      std::uint64_t value = 0;
      std::memcpy(&value, text.data(), sizeof value);
      return value;
    }
    std::uint32_t value = 0;
    std::memcpy(&value, text.data(), sizeof value);
    return value;
  }

  ByteStream& stream_;
  const XmlEncoding& encoding_;
  const std::string& file_;
  const std::string& what_;
  const std::function<void(std::uint64_t)>& check_;
  const Progress& progress_;
};

}  // namespace

bool ByteStream::next_group() {
  std::array<signed char, 4> bits{};
  std::size_t count = 0;
  std::size_t padding = 0;
  std::size_t at = 0;
  while (count + padding < 4) {
    if (at == text_.size()) return false;
    const char c = text_[at++];
    if (kXmlSpace.find(c) != std::string_view::npos) continue;
    if (c == '=') {
      ++padding;
      continue;
    }
    const signed char six = kBits[static_cast<unsigned char>(c)];
    if (six < 0 || padding > 0) return false;
    bits[count++] = six;
  }
  if (count < 2) return false;
  const unsigned group = static_cast<unsigned>(bits[0]) << 18 | static_cast<unsigned>(bits[1]) << 12 |
                         static_cast<unsigned>(bits[2]) << 6 | static_cast<unsigned>(bits[3]);
  pending_count_ = count - 1;
  for (std::size_t i = 0; i < pending_count_; ++i)
    pending_[i] = static_cast<char>(group >> (16 - 8 * i) & 255);
  text_.remove_prefix(at);
  return true;
}

bool ByteStream::read(std::size_t count, std::string& out) {
  if (count > room()) return false;
  if (!is_base64_) {
    out.append(text_.substr(0, count));
    text_.remove_prefix(count);
    return true;
  }
  while (count > 0) {
    if (pending_count_ == 0 && !next_group()) return false;
    const std::size_t some = std::min(count, pending_count_);
    out.append(pending_, some);
    pending_count_ -= some;
    std::copy(pending_ + some, pending_ + some + pending_count_, pending_);
    count -= some;
  }
  return true;
}

std::string_view ByteStream::rest() {
  text_.remove_prefix(std::min(text_.find_first_not_of(kXmlSpace), text_.size()));
  return text_;
}

std::string read_block(ByteStream& stream, const XmlEncoding& encoding, const std::string& file,
                       const std::string& what, const std::function<void(std::uint64_t)>& check,
                       const Progress& progress) {
  BlockReader reader(stream, encoding, file, what, check, progress);
  return encoding.compressed ? reader.inflated() : reader.plain();
}

}  // namespace morsel::core::vtk
