#include <algorithm>
#include <array>

#include "morsel/core/mesh_formats.h"
#include "morsel/core/text_scanner.h"

namespace morsel::core {
namespace {

/// Statements of the format that say nothing about the mesh.
bool is_skipped(std::string_view keyword) {
  static constexpr std::array kKeywords = std::to_array<std::string_view>(
      {"vt",        "vn",     "vp",     "g",    "o",      "s",        "mg",       "p",
       "l",         "curv",   "curv2",  "surf", "cstype", "deg",      "bmat",     "step",
       "parm",      "trim",   "hole",   "scrv", "sp",     "end",      "con",      "usemtl",
       "mtllib",    "usemap", "maplib", "lod",  "bevel",  "c_interp", "d_interp", "shadow_obj",
       "trace_obj", "ctech",  "stech",  "bzp",  "bsp"});
  return std::find(kKeywords.begin(), kKeywords.end(), keyword) != kKeywords.end();
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file, const Progress& progress)
      : file_(file),
        scanner_(bytes, file, {.comment = '#', .continuation = true, .terminator = 0}, progress) {}

  LoadedSoup read() {
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
    const std::size_t vertices = result_.soup.positions.size();
    if (!result_.soup.corners.empty() && highest_ >= vertices)
      fail_reading(file_, "line " + std::to_string(highest_line_) + ": the face names vertex " +
                              std::to_string(std::size_t{highest_} + 1) + ", but the file has only " +
                              std::to_string(vertices) + " vertices, numbered from 1");
    return std::move(result_);
  }

 private:
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
    const auto so_far = static_cast<std::int64_t>(soup.positions.size());
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
      if (c == '\0' || c == ' ' || c == '\t' || c == '\r' || c == '#') return;
      scanner_.fail("expected a corner such as 7 or 7/1/3, found " + shown(std::string_view(&c, 1)) +
                    " in it");
    }
  }

  const std::string& file_;
  TextScanner scanner_;
  LoadedSoup result_;
  Index highest_ = 0;
  std::size_t highest_line_ = 0;  // 0: no face yet
};

}  // namespace

LoadedSoup read_obj(std::string_view bytes, const std::string& file, const Progress& progress) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  return Reader(bytes, file, progress).read();
}

}  // namespace morsel::core
