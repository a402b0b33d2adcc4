#include "morsel/core/io/xml_arrays.h"

#include <zlib.h>

#include <algorithm>
#include <new>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

constexpr std::size_t kPause = 1 << 16;  // numbers between two looks at whether to stop

}  // namespace

std::vector<double> text_numbers(std::string_view text, NumberType type, std::uint64_t count,
                                 const std::string& what, const Progress& progress) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  if (count > text.size() / 2 + 1)
    throw BadInput(what + "it announces " + std::to_string(count) + " numbers, but its text is too short");
  std::vector<double> values;
  values.reserve(count);
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (text.empty()) break;
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    if (values.size() == count)
      throw BadInput(what + "it has more numbers than the " + std::to_string(count) + " announced");
    double value = 0;
    if (!parse_number(word, type, value))
      throw BadInput(what + "number " + std::to_string(values.size()) + ", " + shown(word) +
                     ", is none of its type");
    values.push_back(value);
    if (values.size() % kPause == 0) progress.throw_if_cancelled();
  }
  if (values.size() < count)
    throw BadInput(what + "it has " + std::to_string(values.size()) + " of the " + std::to_string(count) +
                   " numbers announced");
  return values;
}

std::string inflated(std::string_view bytes, std::uint64_t size, const std::string& what,
                     const Progress& progress) {
  struct Stream : z_stream {
    Stream() : z_stream{} {
      if (inflateInit2(this, MAX_WBITS + 32) != Z_OK) throw std::bad_alloc();  // zlib's format or gzip's
    }
    ~Stream() { inflateEnd(this); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
  } stream;
  // Deflate's ratio is 1032 at most.
  if (size / 1040 > bytes.size())
    throw BadInput(what + "its " + std::to_string(bytes.size()) + " compressed bytes cannot become " +
                   std::to_string(size));
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
  std::string out;
  int status = Z_OK;
  while (status == Z_OK) {
    progress.throw_if_cancelled();
    const std::size_t before = out.size();
    // One byte more than there should be shows what is too long.
    const auto room = static_cast<std::size_t>(std::min(kPiece, size - before + 1));
    out.resize(before + room);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + before);
    stream.avail_out = static_cast<uInt>(room);
    if (stream.avail_in == 0) {
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream.avail_in = static_cast<uInt>(std::min<std::size_t>(bytes.size(), 1 << 30));
      bytes.remove_prefix(stream.avail_in);
    }
    status = ::inflate(&stream, Z_NO_FLUSH);
    out.resize(before + room - stream.avail_out);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (out.size() > size)
      throw BadInput(what + "it has more than the " + std::to_string(size) + " bytes that its sizes need");
    if (status == Z_BUF_ERROR && !bytes.empty()) status = Z_OK;
  }
  if (status != Z_STREAM_END) throw BadInput(what + "its compressed data are damaged or cut off");
  if (out.size() != size)
    throw BadInput(what + "it has " + std::to_string(out.size()) + " bytes, but its sizes need " +
                   std::to_string(size));
  return out;
}

}  // namespace morsel::core
