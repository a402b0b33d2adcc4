#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>

#include "morsel/core/io/file_kind.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/io/oddities.h"
#include "morsel/core/parallel/hash_index.h"
#include "morsel/core/text/ascii_case.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

/// The keys of a HashIndex of positions, whose entries are their numbers.
struct PositionKeys {
  static constexpr Index kFree = kNone;
  const std::vector<Point>& positions;

  static std::size_t hash(const Point& p) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9E37'79B9'7F4A'7C15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
  const Point& key(Index v) const { return positions[v]; }
  static bool equal(const Point& a, const Point& b) { return a == b; }
  static bool less(const Point& a, const Point& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }
};

/// Gives equal positions the same number.
class Welder {
 public:
  explicit Welder(std::vector<Point>& positions) : positions_(positions), index_(PositionKeys{positions}) {}

  Index operator()(Point p) {
    p += Point::Zero();  // −0 and 0 are the same place
    const bool is_equal_to_itself = !p.hasNaN();
    const Index known = is_equal_to_itself ? index_.find(p) : kNone;
    if (known != kNone) return known;
    const auto added = static_cast<Index>(positions_.size());
    positions_.push_back(p);
    if (is_equal_to_itself) index_.insert(added);
    return added;
  }

 private:
  std::vector<Point>& positions_;
  HashIndex<Index, PositionKeys> index_;
};

void add_triangle(PolygonSoup& soup, const std::array<Index, 3>& corners) {
  soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
  soup.offsets.push_back(soup.corners.size());
}

constexpr std::size_t kHeader = 84;  // 80 characters and the number of triangles
constexpr std::size_t kRecord = 50;  // normal, three corners, attribute

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// `bytes` hold at least `count` triangles.
LoadedSoup read_binary(std::string_view bytes, std::size_t count, const Progress& progress) {
  LoadedSoup result;
  result.soup.offsets.reserve(count + 1);
  result.soup.corners.reserve(3 * count);
  result.soup.positions.reserve(count / 2);
  Welder welder(result.soup.positions);
  for (std::size_t t = 0; t < count; ++t) {
    if ((t & 0xFFFF) == 0xFFFF) progress.update("reading the mesh", static_cast<double>(t) / count);
    const char* corner = bytes.data() + kHeader + t * kRecord + 12;
    std::array<Index, 3> triangle;
    for (Index& v : triangle) {
      Point p;
      for (int axis = 0; axis < 3; ++axis, corner += 4) p[axis] = std::bit_cast<float>(little_endian(corner));
      v = welder(p);
    }
    add_triangle(result.soup, triangle);
  }
  return result;
}

class TextReader {
 public:
  TextReader(std::string_view bytes, const std::string& file, const Progress& progress)
      : scanner_(bytes, file, {.comment = 0, .continuation = false, .terminator = 0}, progress),
        welder_(result_.soup.positions) {}

  LoadedSoup read() {
    bool inside = false, began = false;
    std::uint64_t other_lines = 0;
    for (;;) {
      const std::string_view word = scanner_.word_on_any_line();
      if (word.empty()) {
        if (inside) scanner_.fail_at_end("before its endsolid");
        add_left_out(result_.warnings, other_lines, "line", "an endsolid");
        return std::move(result_);
      }
      if (!inside && is_keyword(word, "solid")) {
        skip_name();
        inside = true;
        began = true;
      } else if (inside && is_keyword(word, "endsolid")) {
        skip_name();
        inside = false;
      } else if (inside && is_keyword(word, "facet")) {
        read_facet();
      } else if (!inside && began && !is_keyword(word, "facet")) {  // text behind a solid
        skip_name();
        ++other_lines;
      } else {
        scanner_.fail(std::string("expected ") + (inside ? "facet or endsolid" : "solid") + ", found " +
                      shown(word));
      }
    }
  }

 private:
  void skip_name() {
    while (!scanner_.at_line_end()) scanner_.word();
  }

  void expect(std::string_view keyword) {
    const std::string_view word = scanner_.word_on_any_line();
    if (word.empty()) scanner_.fail_at_end("where " + std::string(keyword) + " should be");
    if (!is_keyword(word, keyword))
      scanner_.fail("expected " + std::string(keyword) + ", found " + shown(word));
  }

  void read_facet() {
    expect("normal");
    for (int axis = 0; axis < 3; ++axis)  // often nonsense, and never used
      if (scanner_.word().empty()) scanner_.fail("a normal needs three numbers");
    expect("outer");
    expect("loop");
    std::array<Index, 3> triangle;
    for (Index& v : triangle) {
      expect("vertex");
      const double x = scanner_.number("a coordinate");
      const double y = scanner_.number("a coordinate");
      const double z = scanner_.number("a coordinate");
      v = welder_({x, y, z});
    }
    expect("endloop");
    expect("endfacet");
    add_triangle(result_.soup, triangle);
  }

  TextScanner scanner_;
  LoadedSoup result_;
  Welder welder_;
};

LoadedSoup read_triangles(std::string_view bytes, std::uint64_t count, const std::string& file,
                          const Progress& progress) {
  if (count >= (kNone - 1) / 3) fail_reading(file, "it has more triangles than can be numbered");
  return read_binary(bytes, count, progress);
}

/// A binary file that is longer than its header announces: with bytes behind the triangles, or with 0 for
/// their number, as programs that stream triangles leave it. As any bytes would do for triangles, those of
/// files of other kinds or with coordinates that are not finite are not taken for them: nothing is returned.
std::optional<LoadedSoup> read_with_wrong_count(std::string_view bytes, std::uint64_t announced,
                                                const std::string& file, const Progress& progress) {
  if (!file_kind(bytes).empty()) return std::nullopt;
  const std::size_t room = bytes.size() - kHeader;
  if (announced == 0 && room % kRecord != 0) return std::nullopt;
  LoadedSoup result = read_triangles(bytes, announced == 0 ? room / kRecord : announced, file, progress);
  if (!std::ranges::all_of(result.soup.positions, [](const Point& p) { return p.allFinite(); }))
    return std::nullopt;
  if (announced == 0)
    result.warnings.push_back("its header announces 0 triangles, but it has " +
                              counted(result.soup.polygon_count(), "triangle") + ", which are read");
  else
    add_left_out(result.warnings, room - kRecord * announced, "byte",
                 "the " + counted(announced, "triangle") + " that its header announces");
  return result;
}

}  // namespace

LoadedSoup read_stl(std::string_view bytes, const std::string& file, const Progress& progress) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  // Many binary files begin with "solid" too, but no text has the size that bytes 80 to 83 would ask for.
  const bool has_header = bytes.size() >= kHeader;
  const std::uint64_t announced = has_header ? little_endian(bytes.data() + 80) : 0;
  const std::uint64_t expected = kHeader + kRecord * announced;
  if (has_header && bytes.size() == expected) return read_triangles(bytes, announced, file, progress);
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte-order mark
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size()));
  const bool is_text = text.substr(0, 512).find('\0') == std::string_view::npos;
  if (is_text && is_keyword(text.substr(0, 5), "solid")) return TextReader(bytes, file, progress).read();
  if (!has_header)
    fail_reading(file, "it is neither an ASCII STL file (solid …) nor long enough for a binary one");
  if (bytes.size() > expected && !is_text)
    if (auto soup = read_with_wrong_count(bytes, announced, file, progress)) return std::move(*soup);
  fail_reading(file, "as a binary STL file it announces " + std::to_string(announced) +
                         " triangles, which take " + std::to_string(expected) + " bytes, but it has " +
                         std::to_string(bytes.size()));
}

}  // namespace morsel::core
