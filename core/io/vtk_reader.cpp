// VTK's legacy format (.vtk): polydata and unstructured grids, versions 1 to 5.

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/io/vtk_surface.h"
#include "morsel/core/text/ascii_case.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace vtk {
namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";

struct LegacyType {
  std::string_view name;
  NumberType type;
};
constexpr auto kLegacyTypes = std::to_array<LegacyType>({{"char", NumberType::int8},
                                                         {"signed_char", NumberType::int8},
                                                         {"vtktypeint8", NumberType::int8},
                                                         {"unsigned_char", NumberType::uint8},
                                                         {"vtktypeuint8", NumberType::uint8},
                                                         {"short", NumberType::int16},
                                                         {"vtktypeint16", NumberType::int16},
                                                         {"unsigned_short", NumberType::uint16},
                                                         {"vtktypeuint16", NumberType::uint16},
                                                         {"int", NumberType::int32},
                                                         {"vtktypeint32", NumberType::int32},
                                                         {"vtkidtype", NumberType::int32},  // VTK writes int
                                                         {"unsigned_int", NumberType::uint32},
                                                         {"vtktypeuint32", NumberType::uint32},
                                                         {"long", NumberType::int64},
                                                         {"long_long", NumberType::int64},
                                                         {"vtktypeint64", NumberType::int64},
                                                         {"unsigned_long", NumberType::uint64},
                                                         {"unsigned_long_long", NumberType::uint64},
                                                         {"vtktypeuint64", NumberType::uint64},
                                                         {"float", NumberType::float32},
                                                         {"double", NumberType::float64}});

/// The words, lines and binary numbers of a file, one after the other.
class LegacyCursor {
 public:
  LegacyCursor(std::string_view bytes, const std::string& file, const Progress& progress)
      : bytes_(bytes), file_(file), progress_(progress) {
    if (bytes.starts_with("\xEF\xBB\xBF")) at_ = start_ = 3;  // a byte-order mark
    const std::string_view ends = bytes.substr(std::min(bytes.find_first_of("\r\n"), bytes.size()));
    if (ends.starts_with('\r') &&
        !ends.substr(std::min(ends.find_first_not_of('\r'), ends.size())).starts_with('\n'))
      terminator_ = '\r';  // as on old Macs
  }

  void set_binary(bool binary) { binary_ = binary; }

  /// The next word; empty at the end of the file.
  std::string_view word() {
    at_ = std::min(bytes_.find_first_not_of(kSpace, at_), bytes_.size());
    start_ = at_;
    at_ = std::min(bytes_.find_first_of(kSpace, at_), bytes_.size());
    if ((++steps_ & 0xFFFF) == 0)
      progress_.update("reading the mesh", static_cast<double>(at_) / static_cast<double>(bytes_.size()));
    return bytes_.substr(start_, at_ - start_);
  }
  std::string_view peek_word() {
    const std::size_t at = at_;
    const std::string_view found = word();
    at_ = at;
    return found;
  }
  /// The next word of this line; empty at its end.
  std::string_view word_on_line() {
    std::size_t first = at_;
    while (first < bytes_.size() && bytes_[first] != terminator_ &&
           kSpace.find(bytes_[first]) != std::string_view::npos)
      ++first;
    if (first == bytes_.size() || bytes_[first] == terminator_) return {};
    return word();
  }
  /// The rest of this line, and past its end.
  std::string_view line() {
    start_ = at_;
    const std::size_t end = std::min(bytes_.find(terminator_, at_), bytes_.size());
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }
  bool at_end() const { return at_ == bytes_.size(); }

  std::string_view needed(std::string_view what) {
    const std::string_view found = word();
    if (found.empty()) fail_reading(file_, "it ends where " + std::string(what) + " should be");
    return found;
  }
  std::size_t count(std::string_view what) {
    const std::string_view text = needed(what);
    std::size_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size())
      fail("expected " + std::string(what) + ", found " + shown(text));
    return value;
  }
  NumberType type() {
    const std::string_view text = needed("a type of numbers");
    const auto* found = std::ranges::find_if(
        kLegacyTypes, [&](const LegacyType& candidate) { return is_keyword(text, candidate.name); });
    if (found == kLegacyTypes.end()) fail("numbers of the type " + shown(text) + " are not known");
    return found->type;
  }

  /// `rows` times `columns` numbers, which begin on the next line.
  std::vector<double> numbers(std::size_t rows, std::size_t columns, NumberType type, std::string_view what) {
    const std::size_t count = checked(rows, columns, type, what);
    if (binary_) return decoded(block(count * size_of(type)), type, kSwap, progress_);
    std::vector<double> values(count);
    for (double& value : values) {
      const std::string_view text = needed(what);
      if (!parse_number(text, type, value)) fail("expected " + std::string(what) + ", found " + shown(text));
    }
    return values;
  }
  std::vector<std::int64_t> whole(std::size_t count, NumberType type, std::string_view what) {
    if (!is_whole(type)) fail(std::string(what) + " are whole numbers");
    count = checked(count, 1, type, what);
    if (binary_) return decoded_whole(block(count * size_of(type)), type, kSwap, progress_);
    std::vector<std::int64_t> values(count);
    for (std::int64_t& value : values) {
      const std::string_view text = needed(what);
      if (!parse_whole(text, type, value)) fail("expected " + std::string(what) + ", found " + shown(text));
    }
    return values;
  }
  /// Skips texts, one a line, or each behind its length.
  void skip_strings(std::size_t rows, std::size_t columns) {
    const std::size_t count = checked(rows, columns, NumberType::int8, "texts");
    line();
    for (std::size_t i = 0; i < count; ++i) {
      if (at_end()) fail_reading(file_, "it ends within an array of texts");
      if (!binary_) {
        line();
        continue;
      }
      // The two highest bits tell how many bytes the length has.
      constexpr std::array<std::size_t, 4> kMore = {7, 3, 1, 0};
      const auto first = static_cast<unsigned char>(bytes_[at_]);
      std::uint64_t length = first & 63;
      const std::size_t more = kMore[first >> 6];
      ++at_;
      for (const char c : take(more)) length = length << 8 | static_cast<unsigned char>(c);
      take(length);
    }
  }
  /// Bits, eight a byte.
  std::vector<double> bits(std::size_t rows, std::size_t columns) {
    if (!binary_) return numbers(rows, columns, NumberType::uint8, "a bit");
    if (columns > 8 * remaining() + 8 || (columns > 0 && rows / 8 > remaining() / columns))
      fail_short("bits");
    const std::size_t count = rows * columns;
    if (count / 8 > remaining()) fail_short("bits");
    const std::string_view packed = block(count / 8 + (count % 8 > 0 ? 1 : 0));
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
      values[i] = static_cast<unsigned char>(packed[i / 8]) >> (7 - i % 8) & 1;
    return values;
  }
  /// Bytes of a colour table.
  void skip_colors(std::size_t rows) {
    if (binary_) {
      if (rows > remaining() / 4) fail_short("a colour table");
      block(4 * rows);
    } else {
      numbers(rows, 4, NumberType::float64, "a colour");
    }
  }

  /// Names the line of the last word, or its byte where lines mean nothing.
  [[noreturn]] void fail(const std::string& what) const {
    const std::string place =
        binary_ ? "byte " + std::to_string(start_)
                : "line " + std::to_string(std::ranges::count(bytes_.substr(0, start_), terminator_) + 1);
    fail_reading(file_, place + ": " + what);
  }

 private:
  static constexpr bool kSwap = std::endian::native == std::endian::little;

  std::size_t remaining() const { return bytes_.size() - at_; }
  [[noreturn]] void fail_short(std::string_view what) const {
    fail("the file is too short for the " + std::string(what) + " that are announced here");
  }
  /// Compares with the bytes that are left: a number in a text takes two, but for the last.
  std::size_t checked(std::size_t rows, std::size_t columns, NumberType type, std::string_view what) const {
    const std::size_t room = binary_ ? remaining() / size_of(type) : (remaining() + 1) / 2;
    if (columns > 0 && rows > room / columns)
      fail("the file is too short for " + std::to_string(rows) +
           (columns == 1 ? "" : " times " + std::to_string(columns)) + " numbers (" + std::string(what) +
           ")");
    return rows * columns;
  }
  std::string_view take(std::uint64_t count) {
    if (count > remaining()) fail_reading(file_, "it ends within an array");
    const std::string_view found = bytes_.substr(at_, count);
    at_ += count;
    return found;
  }
  /// Binary numbers, which begin on the next line.
  std::string_view block(std::size_t count) {
    if (count == 0) return {};
    if (const std::string_view rest = line(); rest.find_first_not_of(kSpace) != std::string_view::npos)
      fail("the line goes on with " + shown(rest));
    return take(count);
  }

  std::string_view bytes_;
  const std::string& file_;
  const Progress& progress_;
  bool binary_ = false;
  char terminator_ = '\n';  // of lines: \n or \r
  std::size_t at_ = 0;
  std::size_t start_ = 0;  // of the last word or line
  std::size_t steps_ = 0;
};

/// A name as VTK writes it: %20 for a blank.
std::string decoded_name(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned value = 0;
    if (name[i] == '%' && i + 2 < name.size()) {
      const char* end = name.data() + i + 3;
      if (std::from_chars(name.data() + i + 1, end, value, 16).ptr == end && value >= 32) {
        result += static_cast<char>(value);
        i += 2;
        continue;
      }
    }
    result += name[i];
  }
  return result;
}

class LegacyReader {
 public:
  LegacyReader(std::string_view bytes, const std::string& file, const Progress& progress)
      : file_(file), cursor_(bytes, file, progress), builder_(file, progress) {}

  LoadedSoup read() {
    read_head();
    for (;;) {
      const std::string_view keyword = cursor_.word();
      if (keyword.empty()) break;
      if (!read_geometry(keyword) && !read_data(keyword)) cursor_.fail("unknown keyword " + shown(keyword));
    }
    check_data_read();
    if (!points_) fail_reading(file_, "it has no POINTS");
    builder_.add_points(*points_);
    points_ = std::vector<double>();
    if (is_grid_) {
      if (!cells_[0] || !types_) fail_reading(file_, "it has no CELLS or no CELL_TYPES");
      builder_.add_cells(*cells_[0], *types_);
    } else {
      constexpr std::array<CellType, 4> kTypes = {kPolyVertex, kPolyLine, kPolygon, kTriangleStrip};
      for (std::size_t i = 0; i < kTypes.size(); ++i)
        if (cells_[i]) builder_.add_cells(*std::exchange(cells_[i], {}), kTypes[i]);
    }
    check_count("POINT_DATA", point_data_, builder_.point_count());
    check_count("CELL_DATA", cell_data_, builder_.cell_count());
    return builder_.finish(std::move(point_arrays_), std::move(cell_arrays_));
  }

 private:
  void read_head() {
    const std::string_view first = cursor_.line();
    constexpr std::string_view kMagic = "# vtk datafile version ";
    if (!is_keyword(first.substr(0, kMagic.size()), kMagic))
      fail_reading(file_, "it is no VTK file: its first line is not \"# vtk DataFile Version …\"");
    cursor_.line();  // a title
    const std::string_view encoding = cursor_.needed("ASCII or BINARY");
    is_binary_ = is_keyword(encoding, "binary");
    if (!is_binary_ && !is_keyword(encoding, "ascii"))
      cursor_.fail("expected ASCII or BINARY, found " + shown(encoding));
    const std::string_view keyword = cursor_.needed("DATASET");
    if (!is_keyword(keyword, "dataset")) cursor_.fail("expected DATASET, found " + shown(keyword));
    const std::string_view kind = cursor_.needed("the kind of the data set");
    is_grid_ = is_keyword(kind, "unstructured_grid");
    if (!is_grid_ && !is_keyword(kind, "polydata"))
      cursor_.fail("the data set is " + shown(kind) +
                   ": surfaces are read from POLYDATA and UNSTRUCTURED_GRID");
    cursor_.set_binary(is_binary_);
  }

  /// The points and cells; false if the keyword is none of theirs.
  bool read_geometry(std::string_view keyword) {
    if (is_keyword(keyword, "metadata")) {
      skip_metadata();
    } else if (is_keyword(keyword, "points")) {
      once(points_.has_value(), keyword);
      const std::size_t count = cursor_.count("the number of points");
      const NumberType type = cursor_.type();
      points_ = cursor_.numbers(count, 3, type, "a coordinate");
    } else if (is_grid_ && is_keyword(keyword, "cells")) {
      read_cells(0, keyword);
    } else if (is_grid_ && is_keyword(keyword, "cell_types")) {
      once(types_.has_value(), keyword);
      types_ = cursor_.whole(cursor_.count("the number of cells"), NumberType::int32, "types of cells");
    } else if (!is_grid_) {
      constexpr std::array<std::string_view, 4> kKinds = {"vertices", "lines", "polygons", "triangle_strips"};
      const auto* found =
          std::ranges::find_if(kKinds, [&](std::string_view kind) { return is_keyword(keyword, kind); });
      if (found == kKinds.end()) return false;
      read_cells(static_cast<std::size_t>(found - kKinds.begin()), keyword);
    } else {
      return false;
    }
    return true;
  }

  void once(bool known, std::string_view keyword) const {
    if (known) cursor_.fail(shown(keyword) + " comes twice");
  }

  void read_cells(std::size_t kind, std::string_view keyword) {
    once(cells_[kind].has_value(), keyword);
    const std::size_t count = cursor_.count("the number of cells");
    const std::size_t size = cursor_.count("the number of corners");
    Cells cells;
    if (is_keyword(cursor_.peek_word(), "offsets")) {
      cursor_.word();
      const NumberType type = cursor_.type();
      cells.ends = cursor_.whole(count, type, "offsets");
      if (cells.ends.empty() ? size > 0 : cells.ends.front() != 0)
        cursor_.fail("the offsets of cells do not begin with 0");
      if (!cells.ends.empty()) cells.ends.erase(cells.ends.begin());
      if (const std::string_view next = cursor_.needed("CONNECTIVITY"); !is_keyword(next, "connectivity"))
        cursor_.fail("expected CONNECTIVITY, found " + shown(next));
      const NumberType corner_type = cursor_.type();
      cells.connectivity = cursor_.whole(size, corner_type, "corners");
    } else {
      split(cursor_.whole(size, NumberType::int32, "corners"), count, cells);
    }
    cells_[kind] = std::move(cells);
  }

  /// The form of the versions before 5: each cell's number of corners, and then these.
  void split(std::vector<std::int64_t> numbers, std::size_t count, Cells& cells) const {
    if (count > numbers.size())
      cursor_.fail(std::to_string(count) + " cells do not fit in " + std::to_string(numbers.size()) +
                   " numbers");
    cells.ends.reserve(count);
    std::size_t kept = 0;  // numbers that are corners, moved to the front
    std::size_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t left = numbers.size() - at;
      if (left == 0 || numbers[at] < 0 || static_cast<std::uint64_t>(numbers[at]) > left - 1)
        cursor_.fail("cell " + std::to_string(i) + " of " + std::to_string(count) +
                     " goes beyond the numbers of the cells");
      const auto corners = static_cast<std::size_t>(numbers[at++]);
      std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(at), corners,
                  numbers.begin() + static_cast<std::ptrdiff_t>(kept));
      at += corners;
      kept += corners;
      cells.ends.push_back(static_cast<std::int64_t>(kept));
    }
    if (at != numbers.size())
      cursor_.fail(std::to_string(numbers.size() - at) + " numbers follow the last cell");
    numbers.resize(kept);
    cells.connectivity = std::move(numbers);
  }

  void check_count(std::string_view what, std::optional<std::size_t> announced, std::size_t count) const {
    if (announced && *announced != count)
      fail_reading(file_, std::string(what) + " is for " + std::to_string(*announced) + ", but there are " +
                              std::to_string(count));
  }

  /// POINT_DATA and CELL_DATA promise an array: without one the file has been cut off.
  void check_data_read() const {
    if (arrays_ != nullptr && !has_array_) fail_reading(file_, "it ends before the arrays that it announces");
  }

  bool read_data(std::string_view keyword) {
    for (const bool of_points : {true, false}) {
      if (!is_keyword(keyword, of_points ? "point_data" : "cell_data")) continue;
      check_data_read();
      std::optional<std::size_t>& count = of_points ? point_data_ : cell_data_;
      once(count.has_value(), keyword);
      count = cursor_.count(of_points ? "the number of points" : "the number of cells");
      arrays_ = of_points ? &point_arrays_ : &cell_arrays_;
      tuples_ = *count;
      has_array_ = false;
      return true;
    }
    if (is_keyword(keyword, "field")) {
      read_field();
      has_array_ = true;
      return true;
    }
    if (arrays_ == nullptr) return false;
    if (!read_attribute(keyword)) return false;
    has_array_ = true;
    return true;
  }

  bool read_attribute(std::string_view keyword) {
    struct Attribute {
      std::string_view keyword;
      std::size_t components;
    };
    constexpr auto kAttributes = std::to_array<Attribute>({{"vectors", 3},
                                                           {"normals", 3},
                                                           {"tensors", 9},
                                                           {"tensors6", 6},
                                                           {"global_ids", 1},
                                                           {"pedigree_ids", 1},
                                                           {"edge_flags", 1}});
    if (is_keyword(keyword, "scalars")) {
      const std::string name = array_name();
      const std::string_view type = cursor_.needed("a type of numbers");
      std::size_t components = 1;
      if (const std::string_view more = cursor_.word_on_line(); !more.empty()) {
        const auto [stop, error] = std::from_chars(more.data(), more.data() + more.size(), components);
        if (error != std::errc() || stop != more.data() + more.size() || components == 0)
          cursor_.fail("expected the number of components, found " + shown(more));
      }
      if (is_keyword(cursor_.peek_word(), "lookup_table")) {
        cursor_.word();
        cursor_.needed("the name of a colour table");
      }
      add(name, components, tuples_, type);
    } else if (is_keyword(keyword, "color_scalars")) {
      const std::string name = array_name();
      const std::size_t components = cursor_.count("the number of components");
      add(name, components, tuples_, is_binary_ ? "unsigned_char" : "float");
    } else if (is_keyword(keyword, "texture_coordinates")) {
      const std::string name = array_name();
      const std::size_t components = cursor_.count("the number of components");
      add(name, components, tuples_, cursor_.needed("a type of numbers"));
    } else if (is_keyword(keyword, "lookup_table")) {
      array_name();
      cursor_.skip_colors(cursor_.count("the number of colours"));
    } else {
      const auto* found = std::ranges::find_if(
          kAttributes, [&](const Attribute& attribute) { return is_keyword(keyword, attribute.keyword); });
      if (found == kAttributes.end()) return false;
      const std::string name = array_name();
      add(name, found->components, tuples_, cursor_.needed("a type of numbers"));
    }
    return true;
  }

  std::string array_name() { return decoded_name(cursor_.needed("the name of an array")); }

  /// Arrays of any names; those before POINT_DATA and CELL_DATA belong to the file as a whole.
  void read_field() {
    cursor_.needed("the name of a field");
    const std::size_t count = cursor_.count("the number of arrays");
    for (std::size_t i = 0; i < count; ++i) {
      while (is_keyword(cursor_.peek_word(), "metadata")) {
        cursor_.word();
        skip_metadata();
      }
      const std::string_view raw = cursor_.needed("the name of an array");
      if (raw == "NULL_ARRAY") continue;
      const std::string name = decoded_name(raw);
      const std::size_t components = cursor_.count("the number of components");
      const std::size_t tuples = cursor_.count("the number of tuples");
      add(name, components, tuples, cursor_.needed("a type of numbers"));
    }
  }

  void add(const std::string& name, std::size_t components, std::size_t tuples, std::string_view type) {
    Array array{name, components, {}};
    if (is_keyword(type, "string") || is_keyword(type, "utf8_string")) {
      cursor_.skip_strings(tuples, components);
      if (arrays_ != nullptr) builder_.warn("the array " + shown(name) + " has texts and was left out");
      return;
    }
    if (is_keyword(type, "bit")) {
      array.values = cursor_.bits(tuples, components);
    } else {
      const auto* found = std::ranges::find_if(
          kLegacyTypes, [&](const LegacyType& candidate) { return is_keyword(type, candidate.name); });
      if (found == kLegacyTypes.end()) cursor_.fail("numbers of the type " + shown(type) + " are not known");
      array.values = cursor_.numbers(tuples, components, found->type, "a number of the array " + shown(name));
    }
    if (arrays_ != nullptr) arrays_->push_back(std::move(array));
  }

  /// It ends with a blank line.
  void skip_metadata() {
    cursor_.line();
    while (!cursor_.at_end())
      if (cursor_.line().find_first_not_of(kSpace) == std::string_view::npos) return;
  }

  const std::string& file_;
  LegacyCursor cursor_;
  SurfaceBuilder builder_;
  bool is_binary_ = false;
  bool is_grid_ = false;
  std::optional<std::vector<double>> points_;
  std::array<std::optional<Cells>, 4> cells_;  // of polydata by kind; of a grid the first
  std::optional<std::vector<std::int64_t>> types_;
  std::optional<std::size_t> point_data_;
  std::optional<std::size_t> cell_data_;
  std::vector<Array> point_arrays_;
  std::vector<Array> cell_arrays_;
  std::vector<Array>* arrays_ = nullptr;  // of points or cells, whichever the current section is for
  std::size_t tuples_ = 0;
  bool has_array_ = false;
};

}  // namespace
}  // namespace vtk

LoadedSoup read_vtk(std::string_view bytes, const std::string& file, const Progress& progress) {
  if (bytes.empty()) fail_reading(file, "it is empty");
  return vtk::LegacyReader(bytes, file, progress).read();
}

}  // namespace morsel::core
