#include "morsel/tools/commands/standard_input.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <optional>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/decompression.h"
#include "morsel/core/parallel/exhaustion.h"

namespace morsel::tools {
namespace {

constexpr std::size_t kMost = std::size_t{8} << 30;
constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr int kPause = 200;  // milliseconds between two checks for a stop

core::GrowingBytes read_all(const core::Progress& progress) {
  core::GrowingBytes bytes;
  for (;;) {
    progress.throw_if_cancelled();
    pollfd input{STDIN_FILENO, POLLIN, 0};
    const int ready = ::poll(&input, 1, kPause);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t got = ::read(STDIN_FILENO, bytes.room_for(kPiece), kPiece);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) core::fail_to_read(errno, "cannot read standard input");
    if (got == 0) return bytes;
    bytes.wrote(static_cast<std::size_t>(got));
    if (bytes.size() > kMost)
      throw core::BadInput("standard input has more than 8 GiB, which are kept in memory: name a file");
  }
}

}  // namespace

std::string_view standard_input(const core::Progress& progress) {
  static std::optional<core::GrowingBytes> bytes;  // which can be read only once
  if (!bytes) bytes = read_all(progress);
  return bytes->view();
}

}  // namespace morsel::tools
