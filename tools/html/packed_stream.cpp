#include "morsel/tools/html/packed_stream.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <vector>

#include "morsel/core/parallel/stop.h"
#include "morsel/tools/formats/base64.h"

namespace morsel::tools::html {
namespace {

constexpr std::size_t kBlock = 3 * std::size_t{16384};  // whole groups of three bytes
constexpr std::size_t kPart = std::size_t{1} << 20;     // some ten milliseconds

}  // namespace

struct PackedStream::State {
  explicit State(core::FileWriter& target) : file(target), block(kBlock) {
    if (deflateInit(&stream, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
    stream.next_out = block.data();
    stream.avail_out = kBlock;
  }
  ~State() { deflateEnd(&stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void write_block() {
    file.write(base64({reinterpret_cast<const char*>(block.data()), kBlock - stream.avail_out}));
    stream.next_out = block.data();
    stream.avail_out = kBlock;
  }

  core::FileWriter& file;
  z_stream stream = {};
  std::vector<std::uint8_t> block;
  std::uint64_t taken = 0;
};

PackedStream::PackedStream(core::FileWriter& file) : state_(std::make_unique<State>(file)) {}
PackedStream::~PackedStream() = default;

void PackedStream::write(const void* data, std::size_t size) {
  z_stream& stream = state_->stream;
  state_->taken += size;
  const auto* bytes = static_cast<const Bytef*>(data);
  while (size > 0) {
    core::throw_if_stopped();
    const auto part = static_cast<uInt>(std::min<std::size_t>(size, kPart));
    stream.next_in = const_cast<Bytef*>(bytes);  // zlib does not write to it
    stream.avail_in = part;
    while (stream.avail_in > 0) {
      if (deflate(&stream, Z_NO_FLUSH) != Z_OK) throw std::logic_error("zlib refuses its input");
      if (stream.avail_out == 0) state_->write_block();
    }
    bytes += part;
    size -= part;
  }
}

void PackedStream::finish() {
  int result = Z_OK;
  while (result != Z_STREAM_END) {
    result = deflate(&state_->stream, Z_FINISH);
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
      throw std::logic_error("zlib cannot end its stream");
    if (state_->stream.avail_out == 0 || result == Z_STREAM_END) state_->write_block();
  }
}

std::uint64_t PackedStream::size() const { return state_->taken; }

}  // namespace morsel::tools::html
