#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/text/text_chunks.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

/// Statements of the format that do not concern the mesh.
bool is_skipped(std::string_view keyword) {
  static constexpr std::array kKeywords = std::to_array<std::string_view>(
      {"vt",        "vn",     "vp",     "g",    "o",      "s",        "mg",       "p",
       "l",         "curv",   "curv2",  "surf", "cstype", "deg",      "bmat",     "step",
       "parm",      "trim",   "hole",   "scrv", "sp",     "end",      "con",      "usemtl",
       "mtllib",    "usemap", "maplib", "lod",  "bevel",  "c_interp", "d_interp", "shadow_obj",
       "trace_obj", "ctech",  "stech",  "bzp",  "bsp"});
  return std::find(kKeywords.begin(), kKeywords.end(), keyword) != kKeywords.end();
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& file, const Progress& progress)
      : file_(file),
        scanner_(bytes, file, {.comment = '#', .continuation = true, .terminator = 0}, progress) {}

  /// Of a piece of a file with `vertices_before` vertices before it and without continued lines.
  ObjReader(std::string_view lines, char terminator, std::size_t vertices_before, const std::string& file,
            const Progress& progress)
      : file_(file),
        scanner_(lines, file, {.comment = '#', .continuation = false, .terminator = terminator}, progress),
        vertices_before_(vertices_before) {}

  LoadedSoup read() {
    read_statements();
    const std::size_t vertices = result_.soup.positions.size();
    if (!result_.soup.corners.empty() && highest_ >= vertices)
      fail_reading(file_, "line " + std::to_string(highest_line_) + ": the face names vertex " +
                              std::to_string(std::size_t{highest_} + 1) + ", but the file has only " +
                              std::to_string(vertices) + " vertices, numbered from 1");
    return std::move(result_);
  }

  /// The statements of a piece; corners are checked against `vertices`, the number in the whole file.
  PolygonSoup read_piece(std::size_t vertices) {
    read_statements();
    if (!result_.soup.corners.empty() && highest_ >= vertices) fail_reading(file_, "a face names no vertex");
    return std::move(result_.soup);
  }

  std::size_t count_vertices() {
    std::size_t count = 0;
    while (scanner_.next_line()) count += scanner_.word() == "v" ? 1 : 0;
    return count;
  }

 private:
  void read_statements() {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v")
        read_vertex();
      else if (keyword == "f" || keyword == "fo")
        read_face();
      else if (is_skipped(keyword))
        skip_statement();
      else
        scanner_.fail("an OBJ file has no statement " + shown(keyword));
    }
  }

  void skip_statement() {
    while (!scanner_.at_line_end()) scanner_.word();  // word by word, for the sake of continued lines
  }

  void read_vertex() {
    const double x = scanner_.number("a coordinate");
    const double y = scanner_.number("a coordinate");
    const double z = scanner_.number("a coordinate");
    int more = 0;  // a weight, a colour, or both
    for (; !scanner_.at_line_end(); ++more) scanner_.number("a number");
    if (more > 5) scanner_.fail("a vertex has at most 8 numbers, not " + std::to_string(3 + more));
    if (result_.soup.positions.size() >= kNone - 1)
      scanner_.fail("there are more vertices than can be numbered");
    result_.soup.positions.emplace_back(x, y, z);
  }

  /// Corners "7", "7/1", "7/1/3", "7//3"; a negative index counts back from the last vertex so far.
  void read_face() {
    PolygonSoup& soup = result_.soup;
    const auto so_far = static_cast<std::int64_t>(vertices_before_ + soup.positions.size());
    while (!scanner_.at_line_end()) {
      const std::int64_t number = scanner_.leading_integer("a corner of the face");
      skip_attributes();
      if (number == 0) scanner_.fail("the face names vertex 0, but vertices are numbered from 1");
      if (number < -so_far || number >= std::int64_t{kNone})
        scanner_.fail("the face names vertex " + std::to_string(number) + ", but there are only " +
                      std::to_string(so_far) + " vertices before it");
      const auto v = static_cast<Index>(number > 0 ? number - 1 : so_far + number);
      if (v > highest_ || highest_line_ == 0) {
        highest_ = v;
        highest_line_ = scanner_.line();
      }
      soup.corners.push_back(v);
    }
    soup.offsets.push_back(soup.corners.size());
  }

  void skip_attributes() {
    int slashes = 0;
    for (;; scanner_.skip()) {
      const char c = scanner_.peek();
      if (c == '/' ? ++slashes <= 2 : slashes > 0 && ((c >= '0' && c <= '9') || c == '-')) continue;
      if (scanner_.at_word_end()) return;
      scanner_.fail("expected a corner such as 7 or 7/1/3, found " + shown(std::string_view(&c, 1)) +
                    " in it");
    }
  }

  const std::string& file_;
  TextScanner scanner_;
  std::size_t vertices_before_ = 0;
  LoadedSoup result_;
  Index highest_ = 0;
  std::size_t highest_line_ = 0;  // 0: no face yet
};

/// Reads it in parallel, in pieces of `chunk` bytes; nothing if it is too short for that or has an error.
std::optional<PolygonSoup> read_in_chunks(std::string_view bytes, const std::string& file,
                                          const Progress& progress, std::size_t chunk) {
  const Progress silent = progress.unreported();
  const char terminator =
      TextScanner(bytes, file, {.comment = '#', .continuation = true, .terminator = 0}, silent).terminator();
  if (bytes.find('\\') != std::string_view::npos) return std::nullopt;  // a line may be continued
  const std::vector<std::string_view> chunks = line_chunks(bytes, terminator, chunk);
  const std::vector<std::size_t> vertices_before = items_before(
      chunks,
      [&](std::string_view lines) { return ObjReader(lines, terminator, 0, file, silent).count_vertices(); },
      progress);
  if (chunks.empty() || vertices_before.back() >= kNone) return std::nullopt;
  return read_chunks(
      chunks.size(),
      [&](std::size_t k) {
        return ObjReader(chunks[k], terminator, vertices_before[k], file, silent)
            .read_piece(vertices_before.back());
      },
      progress);
}

}  // namespace

LoadedSoup read_obj(std::string_view bytes, const std::string& file, const Progress& progress) {
  return read_obj(bytes, file, progress, kTextChunk);
}

LoadedSoup read_obj(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  if (auto soup = read_in_chunks(bytes, file, progress, chunk)) return {std::move(*soup), {}};
  return ObjReader(bytes, file, progress).read();
}

}  // namespace morsel::core
