#include "morsel/core/io/decompression.h"

#include <lzma.h>
#include <zlib.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <limits>
#include <new>

#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;         // bytes between two checks
constexpr std::size_t kDictionary = std::size_t{256} << 20;  // of xz and zstd
constexpr std::size_t kLargestInput = std::size_t{1} << 30;  // at once, for counters of 32 bits

/// What decompresses a kind of data, stream after stream.
class Decoder {
 public:
  Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  virtual ~Decoder() = default;

  struct Step {
    std::size_t written;          ///< bytes that came out
    bool ends = false;            ///< the stream does
    const char* error = nullptr;  ///< what is wrong with the data, if anything
  };
  /// Moves `in` past what it used; writes at most `room` bytes.
  virtual Step step(std::string_view& in, char* out, std::size_t room) = 0;
  virtual void begin_stream() = 0;
};

const unsigned char* as_unsigned(const char* bytes) { return reinterpret_cast<const unsigned char*>(bytes); }
unsigned char* as_unsigned(char* bytes) { return reinterpret_cast<unsigned char*>(bytes); }

class GzipDecoder : public Decoder {
 public:
  GzipDecoder() {
    constexpr int kGzipOnly = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) throw std::bad_alloc();
  }
  ~GzipDecoder() override { inflateEnd(&stream_); }

  void begin_stream() override { inflateReset(&stream_); }
  Step step(std::string_view& in, char* out, std::size_t room) override {
    const auto given = static_cast<uInt>(std::min(in.size(), kLargestInput));
    stream_.next_in = const_cast<Bytef*>(as_unsigned(in.data()));
    stream_.avail_in = given;
    stream_.next_out = as_unsigned(out);
    stream_.avail_out = static_cast<uInt>(room);
    const int result = inflate(&stream_, Z_NO_FLUSH);
    const std::size_t written = room - stream_.avail_out;
    in.remove_prefix(given - stream_.avail_in);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result == Z_STREAM_END) return {written, true};
    if (result == Z_OK || result == Z_BUF_ERROR) return {written};
    return {written, false, stream_.msg == nullptr ? "invalid data" : stream_.msg};
  }

 private:
  z_stream stream_{};
};

class XzDecoder : public Decoder {
 public:
  XzDecoder() { begin_stream(); }
  ~XzDecoder() override { lzma_end(&stream_); }

  void begin_stream() override {
    // Initialising a stream again keeps what it has allocated.
    if (lzma_stream_decoder(&stream_, kDictionary, 0) != LZMA_OK) throw std::bad_alloc();
  }
  Step step(std::string_view& in, char* out, std::size_t room) override {
    const std::size_t given = in.size();
    stream_.next_in = as_unsigned(in.data());
    stream_.avail_in = given;
    stream_.next_out = as_unsigned(out);
    stream_.avail_out = room;
    const lzma_ret result = lzma_code(&stream_, LZMA_RUN);
    const std::size_t written = room - stream_.avail_out;
    in.remove_prefix(given - stream_.avail_in);
    switch (result) {
      case LZMA_STREAM_END:
        return {written, true};
      case LZMA_OK:
      case LZMA_BUF_ERROR:
        return {written};
      case LZMA_MEM_ERROR:
        throw std::bad_alloc();
      case LZMA_MEMLIMIT_ERROR:
        return {written, false, "their dictionary is larger than 256 MiB"};
      case LZMA_OPTIONS_ERROR:
        return {written, false, "they use options that are not supported"};
      default:
        return {written, false, "invalid data or a wrong checksum"};
    }
  }

 private:
  lzma_stream stream_ = LZMA_STREAM_INIT;
};

class ZstdDecoder : public Decoder {
 public:
  ZstdDecoder() : stream_(ZSTD_createDStream()) {
    if (stream_ == nullptr) throw std::bad_alloc();
    ZSTD_DCtx_setParameter(stream_, ZSTD_d_windowLogMax, 28);  // kDictionary
  }
  ~ZstdDecoder() override { ZSTD_freeDStream(stream_); }

  void begin_stream() override { ZSTD_DCtx_reset(stream_, ZSTD_reset_session_only); }
  Step step(std::string_view& in, char* out, std::size_t room) override {
    ZSTD_inBuffer input{in.data(), in.size(), 0};
    ZSTD_outBuffer output{out, room, 0};
    const std::size_t result = ZSTD_decompressStream(stream_, &output, &input);
    in.remove_prefix(input.pos);
    if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
    if (ZSTD_isError(result) != 0) return {output.pos, false, ZSTD_getErrorName(result)};
    return {output.pos, result == 0};
  }

 private:
  ZSTD_DStream* stream_;
};

std::unique_ptr<Decoder> decoder_of(Compression kind) {
  if (kind == Compression::gzip) return std::make_unique<GzipDecoder>();
  if (kind == Compression::xz) return std::make_unique<XzDecoder>();
  return std::make_unique<ZstdDecoder>();
}

constexpr const char* name_of(Compression kind) {
  return kind == Compression::gzip ? "gzip" : kind == Compression::xz ? "xz" : "zstd";
}

}  // namespace

GrowingBytes decompress(std::string_view bytes, Compression kind, const std::string& file,
                        const Progress& progress, const DecompressionLimit& limit) {
  const std::string compressed = std::string("its ") + name_of(kind) + " data ";
  const std::size_t most = limit.for_size(bytes.size());
  const std::unique_ptr<Decoder> decoder = decoder_of(kind);
  GrowingBytes result;
  std::string_view rest = bytes;
  for (bool first = true;; first = false) {
    if (!first) {
      rest.remove_prefix(std::min(rest.find_first_not_of('\0'), rest.size()));  // padding
      if (rest.empty()) return result;
      if (compression_of(rest) != kind)
        fail_reading(file, compressed + "end before its last " + std::to_string(rest.size()) +
                               " bytes, which are something else");
      decoder->begin_stream();
    }
    for (bool ended = false; !ended;) {
      progress.update("decompressing",
                      1 - static_cast<double>(rest.size()) / static_cast<double>(bytes.size()));
      char* const out = result.room_for(kPiece);
      const std::size_t before = rest.size();
      const Decoder::Step step = decoder->step(rest, out, kPiece);
      if (step.error != nullptr) fail_reading(file, compressed + "are damaged: " + step.error);
      ended = step.ends;
      result.wrote(step.written);
      if (result.size() > most)
        fail_reading(file, compressed + "expand to more than " + std::to_string(most >> 20) + " MiB, over " +
                               std::to_string(most / std::max<std::size_t>(bytes.size(), 1)) +
                               " times their size, which is refused: decompress it first if that is meant");
      if (!ended && step.written == 0 && rest.size() == before)
        fail_reading(file, compressed + "are truncated");
    }
  }
}

}  // namespace morsel::core
