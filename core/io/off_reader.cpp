#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/text/text_chunks.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

/// The header's contents.
struct OffHeader {
  bool texture = false;
  bool color = false;
  bool normal = false;
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& file, const Progress& progress)
      : file_(file),
        scanner_(bytes, file, {.comment = '#', .continuation = false, .terminator = 0}, progress),
        progress_(progress) {}

  /// Of a piece of a file whose header was read.
  OffReader(std::string_view lines, char terminator, const OffHeader& header, const std::string& file,
            const Progress& progress)
      : file_(file),
        scanner_(lines, file, {.comment = '#', .continuation = false, .terminator = terminator}, progress),
        progress_(progress),
        header_(header) {}

  /// In parallel if the text is longer than two pieces of `chunk` bytes.
  LoadedSoup read(std::size_t chunk) {
    read_header();
    if (read_in_chunks(chunk)) return std::move(result_);
    read_vertices(0, header_.vertices);
    read_faces(0, header_.faces);
    if (scanner_.next_line())
      scanner_.fail("the file goes on after the " + std::to_string(header_.vertices) + " vertices and " +
                    std::to_string(header_.faces) + " faces that its header announces");
    return std::move(result_);
  }

 private:
  /// Reads all that follows the header, in parallel. False if it is too short for that or has an error.
  bool read_in_chunks(std::size_t chunk) {
    const char terminator = scanner_.terminator();
    const std::vector<std::string_view> chunks = line_chunks(scanner_.rest(), terminator, chunk);
    const Progress silent = progress_.unreported();
    const std::vector<std::size_t> lines_before = items_before(
        chunks,
        [&](std::string_view lines) {
          OffReader reader(lines, terminator, header_, file_, silent);
          std::size_t count = 0;
          while (reader.scanner_.next_line()) ++count;
          return count;
        },
        progress_);
    if (chunks.empty() || lines_before.back() != header_.vertices + header_.faces) return false;
    const auto vertices = std::size_t{header_.vertices};
    auto soup = read_chunks(
        chunks.size(),
        [&](std::size_t k) {
          OffReader reader(chunks[k], terminator, header_, file_, silent);
          const std::size_t first = lines_before[k];
          const std::size_t last = lines_before[k + 1];
          reader.read_vertices(std::min(first, vertices), std::min(last, vertices));
          reader.read_faces(std::max(first, vertices) - vertices, std::max(last, vertices) - vertices);
          return std::move(reader.result_.soup);
        },
        progress_);
    if (soup) result_.soup = std::move(*soup);
    return soup.has_value();
  }

  void read_header() {
    if (!scanner_.next_line()) fail_reading(file_, "it is empty");
    const std::string_view first = scanner_.peek_word();
    if (!std::all_of(first.begin(), first.end(), is_digit)) {  // Geomview lets the keyword be missing
      read_keyword();
      if (scanner_.at_line_end() && !scanner_.next_line())
        scanner_.fail_at_end("before the numbers of vertices and faces");
    }
    header_.vertices = count("the number of vertices");
    header_.faces = count("the number of faces");
    if (!scanner_.at_line_end()) scanner_.integer("the number of edges");
    if (!scanner_.at_line_end())
      scanner_.fail("expected the line to end after the numbers of vertices, faces and edges, found " +
                    shown(scanner_.word()));
    // "0 0 0" and a line's end; "0" and a line's end.
    if (header_.vertices > (scanner_.remaining() + 1) / 6 || header_.vertices >= kNone)
      scanner_.fail("the header announces " + std::to_string(header_.vertices) +
                    " vertices, but the file is too short for them");
    if (header_.faces > (scanner_.remaining() + 1) / 2)
      scanner_.fail("the header announces " + std::to_string(header_.faces) +
                    " faces, but the file is too short for them");
  }

  /// "OFF", "NOFF", "STCNOFF", …, and "OFF8 6 12" as some data sets have it.
  void read_keyword() {
    std::string prefix;
    while (std::isalnum(static_cast<unsigned char>(scanner_.peek())) != 0 && !prefix.ends_with("OFF") &&
           prefix.size() < 12) {
      prefix += scanner_.peek();
      scanner_.skip();
    }
    if (!prefix.ends_with("OFF"))
      scanner_.fail("an OFF file begins with OFF (or COFF, NOFF, STOFF, …), not with " + shown(prefix));
    for (std::string_view rest(prefix.data(), prefix.size() - 3); !rest.empty();) {
      if (rest.starts_with("ST") && !header_.texture) {
        header_.texture = true;
        rest.remove_prefix(2);
      } else if (rest.front() == 'C' && !header_.color) {
        header_.color = true;
        rest.remove_prefix(1);
      } else if (rest.front() == 'N' && !header_.normal) {
        header_.normal = true;
        rest.remove_prefix(1);
      } else {
        scanner_.fail("this kind of OFF file is not supported: " + shown(prefix));
      }
    }
    if (scanner_.at_line_end() || is_digit(scanner_.peek())) return;
    const std::string_view word = scanner_.word();
    scanner_.fail(word == "BINARY" ? "binary OFF files are not supported"
                                   : "expected the number of vertices, found " + shown(word));
  }

  std::uint64_t count(std::string_view what) {
    const std::int64_t number = scanner_.integer(what);
    if (number < 0) scanner_.fail(std::string(what) + " is " + std::to_string(number));
    return static_cast<std::uint64_t>(number);
  }

  void read_vertices(std::uint64_t first, std::uint64_t last) {
    // Colours have three or four numbers; a file that has them without announcing them is common.
    const int fixed = (header_.normal ? 3 : 0) + (header_.texture ? 2 : 0);
    const bool plain = fixed == 0 && !header_.color;
    auto& positions = result_.soup.positions;
    positions.reserve(last - first);
    for (std::uint64_t v = first; v < last; ++v) {
      if (!scanner_.next_line())
        scanner_.fail_at_end("after " + std::to_string(v) + " of " + std::to_string(header_.vertices) +
                             " vertices");
      const double x = scanner_.number("a coordinate");
      const double y = scanner_.number("a coordinate");
      const double z = scanner_.number("a coordinate");
      positions.emplace_back(x, y, z);
      int more = 0;
      for (; !scanner_.at_line_end(); ++more) scanner_.number("a number");
      const int color = more - fixed;
      const bool right = color == 3 || color == 4 ? header_.color || plain : color == 0 && !header_.color;
      if (!right)
        scanner_.fail("vertex " + std::to_string(v) + " has " + std::to_string(3 + more) +
                      " numbers, which is not what this kind of OFF file has on the line of a vertex");
    }
  }

  void read_faces(std::uint64_t first, std::uint64_t last) {
    PolygonSoup& soup = result_.soup;
    soup.offsets.reserve(last - first + 1);
    soup.corners.reserve(std::min<std::size_t>(3 * (last - first), scanner_.remaining() / 2));
    for (std::uint64_t f = first; f < last; ++f) {
      if (!scanner_.next_line())
        scanner_.fail_at_end("after " + std::to_string(f) + " of " + std::to_string(header_.faces) +
                             " faces");
      const std::uint64_t corners = count("the face's number of corners");
      for (std::uint64_t i = 0; i < corners; ++i) {
        const std::int64_t v = scanner_.integer("a corner of the face");
        if (v < 0 || v >= static_cast<std::int64_t>(header_.vertices))
          scanner_.fail("face " + std::to_string(f) + " names vertex " + std::to_string(v) +
                        ", but there are only " + std::to_string(header_.vertices) +
                        " vertices, numbered from 0");
        soup.corners.push_back(static_cast<Index>(v));
      }
      soup.offsets.push_back(soup.corners.size());
      while (!scanner_.at_line_end()) scanner_.number("a colour");
    }
  }

  const std::string& file_;
  TextScanner scanner_;
  const Progress& progress_;
  OffHeader header_;
  LoadedSoup result_;
};

}  // namespace

LoadedSoup read_off(std::string_view bytes, const std::string& file, const Progress& progress) {
  return read_off(bytes, file, progress, kTextChunk);
}

LoadedSoup read_off(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk) {
  return OffReader(bytes, file, progress).read(chunk);
}

}  // namespace morsel::core
