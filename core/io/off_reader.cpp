#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/io/oddities.h"
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

  std::string announced() const {
    return counted(vertices, "vertex", "vertices") + " and " + counted(faces, "face") +
           " that its header announces";
  }
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads the header; the scanner stands after its last number.
class OffHeaderReader {
 public:
  OffHeaderReader(TextScanner& scanner, const std::string& file) : scanner_(scanner), file_(file) {}

  OffHeader read() {
    if (!scanner_.next_line()) fail_reading(file_, "it is empty");
    const std::string_view first = scanner_.peek_word();
    if (!std::all_of(first.begin(), first.end(), is_digit)) {  // Geomview lets the keyword be missing
      read_keyword();
      if (scanner_.at_line_end() && !scanner_.next_line())
        scanner_.fail_at_end("before the numbers of vertices and faces");
    }
    header_.vertices = count("the number of vertices");
    if (scanner_.at_line_end() && !scanner_.next_line()) scanner_.fail_at_end("before the number of faces");
    header_.faces = count("the number of faces");
    if (!scanner_.at_line_end() || is_alone_on_next_line()) scanner_.integer("the number of edges");
    // "0 0 0" and a blank; "0" and a blank.
    if (header_.vertices > (scanner_.remaining_here() + 1) / 6 || header_.vertices >= kNone)
      scanner_.fail("the header announces " + std::to_string(header_.vertices) +
                    " vertices, but the file is too short for them");
    if (header_.faces > (scanner_.remaining_here() + 1) / 2)
      scanner_.fail("the header announces " + std::to_string(header_.faces) +
                    " faces, but the file is too short for them");
    return header_;
  }

 private:
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

  /// Whether the next line has one whole number, that of edges, to which the scanner then goes. (A vertex
  /// whose coordinates have a line each cannot be told from it; where edges are counted, as they should be,
  /// there is no such line.)
  bool is_alone_on_next_line() {
    TextScanner ahead = scanner_;
    if (!ahead.next_line()) return false;
    const std::string_view word = ahead.word();
    if (!ahead.at_line_end() || !std::all_of(word.begin(), word.end(), is_digit)) return false;
    return scanner_.next_line();
  }

  TextScanner& scanner_;
  const std::string& file_;
  OffHeader header_;
};

std::string ends_after(std::uint64_t number, std::uint64_t of, const char* what) {
  return "after " + std::to_string(number) + " of " + std::to_string(of) + " " + what;
}

/// A face's number of corners, or one of them; `number` is the face's.
std::uint64_t off_corner_count(TextScanner& scanner) {
  const std::int64_t corners = scanner.integer("the face's number of corners");
  if (corners < 0) scanner.fail("the face's number of corners is " + std::to_string(corners));
  return static_cast<std::uint64_t>(corners);
}
Index off_corner(TextScanner& scanner, const OffHeader& header, std::uint64_t number) {
  const std::int64_t v = scanner.integer("a corner of the face");
  if (v < 0 || v >= static_cast<std::int64_t>(header.vertices))
    scanner.fail("face " + std::to_string(number) + " names vertex " + std::to_string(v) +
                 ", but there are only " + std::to_string(header.vertices) + " vertices, numbered from 0");
  return static_cast<Index>(v);
}

/// Reads what follows the header where each vertex and each face has a line.
class OffLines {
 public:
  OffLines(TextScanner scanner, const OffHeader& header) : scanner_(scanner), header_(header) {}

  LoadedSoup read() {
    read_vertices(0, header_.vertices);
    read_faces(0, header_.faces);
    return std::move(result_);
  }
  /// After read(): the number of lines behind the faces.
  std::uint64_t count_lines() {
    std::uint64_t lines = 0;
    while (scanner_.next_line()) ++lines;
    return lines;
  }

  void read_vertices(std::uint64_t first, std::uint64_t last) {
    // Colours have three or four numbers; a file that has them without announcing them is common.
    const int fixed = (header_.normal ? 3 : 0) + (header_.texture ? 2 : 0);
    const bool plain = fixed == 0 && !header_.color;
    auto& positions = result_.soup.positions;
    positions.reserve(last - first);
    for (std::uint64_t v = first; v < last; ++v) {
      if (!scanner_.next_line()) scanner_.fail_at_end(ends_after(v, header_.vertices, "vertices"));
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
      has_lines_ = true;
    }
  }

  void read_faces(std::uint64_t first, std::uint64_t last) {
    PolygonSoup& soup = result_.soup;
    soup.offsets.reserve(last - first + 1);
    soup.corners.reserve(std::min<std::size_t>(3 * (last - first), scanner_.remaining() / 2));
    has_lines_ = false;
    for (std::uint64_t f = first; f < last; ++f) {
      if (!scanner_.next_line()) scanner_.fail_at_end(ends_after(f, header_.faces, "faces"));
      const std::uint64_t corners = off_corner_count(scanner_);
      for (std::uint64_t i = 0; i < corners; ++i) soup.corners.push_back(off_corner(scanner_, header_, f));
      soup.offsets.push_back(soup.corners.size());
      while (!scanner_.at_line_end()) scanner_.number("a colour");
      has_lines_ = true;
    }
  }

  /// Whether a line was read of what was being read last, vertices or faces: an error is then that of a file
  /// of lines.
  bool has_lines() const { return has_lines_; }
  PolygonSoup take() { return std::move(result_.soup); }

 private:
  TextScanner scanner_;
  const OffHeader& header_;
  LoadedSoup result_;
  bool has_lines_ = false;
};

/// Reads what follows the header where numbers may be on any lines.
class OffNumbers {
 public:
  /// `color`: how many numbers the colour of a vertex has.
  OffNumbers(TextScanner scanner, const OffHeader& header, int color)
      : scanner_(scanner),
        header_(header),
        skipped_((header.normal ? 3 : 0) + (header.texture ? 2 : 0) + color) {}

  PolygonSoup read() {
    read_vertices();
    const bool is_at_line_end = scanner_.at_line_end();
    try {
      return with_one_number_after_another();
    } catch (const BadInput& error) {
      if (!is_at_line_end)
        throw BadInput(std::string(error.what()) +
                       " (faces with colours are read only where the vertices end with a line)");
    }
    return with_faces_at_line_starts();
  }

 private:
  void read_vertices() {
    auto& positions = soup_.positions;
    positions.reserve(header_.vertices);
    for (std::uint64_t v = 0; v < header_.vertices; ++v) {
      Point p;
      for (int axis = 0; axis < 3; ++axis) {
        go_to_number(v, header_.vertices, "vertices");
        p[axis] = scanner_.number("a coordinate");
      }
      for (int i = 0; i < skipped_; ++i) {
        go_to_number(v, header_.vertices, "vertices");
        scanner_.number("a number");
      }
      positions.push_back(p);
    }
  }

  /// Faces without colours, whose numbers are all that follow.
  PolygonSoup with_one_number_after_another() const {
    OffNumbers faces(scanner_, header_, 0);
    for (std::uint64_t f = 0; f < header_.faces; ++f) faces.read_face(f);
    if (!faces.scanner_.at_line_end() || faces.scanner_.next_line())
      faces.scanner_.fail("the file goes on after the " + header_.announced());
    faces.soup_.positions = soup_.positions;
    return std::move(faces.soup_);
  }

  /// Each face begins a line. Colours follow the corners of one that ends in that line.
  PolygonSoup with_faces_at_line_starts() {
    for (std::uint64_t f = 0; f < header_.faces; ++f) {
      if (!scanner_.next_line()) scanner_.fail_at_end(ends_after(f, header_.faces, "faces"));
      const std::size_t line = scanner_.line();
      read_face(f);
      if (scanner_.line() == line)
        while (!scanner_.at_line_end()) scanner_.number("a colour");
      if (!scanner_.at_line_end())
        scanner_.fail("face " + std::to_string(f) + " goes over several lines, and more follows its corners");
    }
    if (scanner_.next_line()) scanner_.fail("the file goes on after the " + header_.announced());
    return std::move(soup_);
  }

  void read_face(std::uint64_t f) {
    go_to_number(f, header_.faces, "faces");
    const std::uint64_t corners = off_corner_count(scanner_);
    if (corners < 3)  // would let other numbers pass for faces
      scanner_.fail("face " + std::to_string(f) + " has " + counted(corners, "corner"));
    for (std::uint64_t i = 0; i < corners; ++i) {
      go_to_number(f, header_.faces, "faces");
      soup_.corners.push_back(off_corner(scanner_, header_, f));
    }
    soup_.offsets.push_back(soup_.corners.size());
  }

  /// On this line or a later one.
  void go_to_number(std::uint64_t number, std::uint64_t of, const char* what) {
    if (scanner_.at_line_end() && !scanner_.next_line()) scanner_.fail_at_end(ends_after(number, of, what));
  }

  TextScanner scanner_;
  const OffHeader& header_;
  int skipped_;  // numbers of a vertex after its coordinates
  PolygonSoup soup_;
};

/// With each number of numbers that a colour may have; if none of them works, the last one's error.
PolygonSoup read_numbers(const TextScanner& scanner, const OffHeader& header) {
  if (!header.color) return OffNumbers(scanner, header, 0).read();
  try {
    return OffNumbers(scanner, header, 3).read();
  } catch (const BadInput&) {
    return OffNumbers(scanner, header, 4).read();
  }
}

/// What follows the header, in parallel. Nothing if it is too short for that, has no line for each vertex and
/// face, or has an error.
std::optional<LoadedSoup> read_in_chunks(const TextScanner& scanner, const OffHeader& header,
                                         const std::string& file, const Progress& progress,
                                         std::size_t chunk) {
  const TextScanner::Syntax syntax{.comment = '#', .continuation = false, .terminator = scanner.terminator()};
  const std::vector<std::string_view> chunks = line_chunks(scanner.rest(), syntax.terminator, chunk);
  const Progress silent = progress.unreported();
  const std::vector<std::size_t> lines_before = items_before(
      chunks,
      [&](std::string_view lines) {
        TextScanner piece(lines, file, syntax, silent);
        std::size_t count = 0;
        while (piece.next_line()) ++count;
        return count;
      },
      progress);
  const auto vertices = std::size_t{header.vertices};
  const std::size_t all = vertices + header.faces;
  if (chunks.empty() || lines_before.back() < all) return std::nullopt;
  auto soup = read_chunks(
      chunks.size(),
      [&](std::size_t k) {
        OffLines lines(TextScanner(chunks[k], file, syntax, silent), header);
        const std::size_t first = std::min(lines_before[k], all);
        const std::size_t last = std::min(lines_before[k + 1], all);
        lines.read_vertices(std::min(first, vertices), std::min(last, vertices));
        lines.read_faces(std::max(first, vertices) - vertices, std::max(last, vertices) - vertices);
        return lines.take();
      },
      progress);
  if (!soup) return std::nullopt;
  LoadedSoup result{.soup = std::move(*soup), .properties = {}};
  add_left_out(result.warnings, lines_before.back() - all, "line", "the " + header.announced());
  return result;
}

}  // namespace

LoadedSoup read_off(std::string_view bytes, const std::string& file, const Progress& progress) {
  return read_off(bytes, file, progress, kTextChunk);
}

LoadedSoup read_off(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk) {
  TextScanner scanner(bytes, file, {.comment = '#', .continuation = false, .terminator = 0}, progress);
  const OffHeader header = OffHeaderReader(scanner, file).read();
  if (!scanner.at_line_end()) return {.soup = read_numbers(scanner, header), .properties = {}};
  if (auto soup = read_in_chunks(scanner, header, file, progress, chunk)) return std::move(*soup);
  OffLines lines(scanner, header);
  try {
    LoadedSoup result = lines.read();
    add_left_out(result.warnings, lines.count_lines(), "line", "the " + header.announced());
    return result;
  } catch (const BadInput&) {
    // A file of lines has the error of its lines; one without has that of its numbers.
    const bool has_lines = lines.has_lines();
    try {
      return {.soup = read_numbers(scanner, header), .properties = {}};
    } catch (const BadInput&) {
      if (!has_lines) throw;
    }
    throw;
  }
}

}  // namespace morsel::core
