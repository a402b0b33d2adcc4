#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/elevation_grid.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/ascii_case.h"
#include "morsel/core/text/text_chunks.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

constexpr TextScanner::Syntax kGridSyntax = {.comment = 0, .continuation = false, .terminator = 0};

constexpr std::size_t kLongestKey = 32;  // more than any has

class GridReader {
 public:
  GridReader(std::string_view bytes, const std::string& file, const Progress& progress)
      : bytes_(bytes), file_(file), progress_(progress), scanner_(bytes, file, kGridSyntax, progress) {}

  /// In parallel if the text is longer than two pieces of `chunk` bytes.
  LoadedSoup read(std::size_t chunk) {
    read_header();
    grid_.values.resize(grid_.columns * grid_.rows);
    if (!read_in_chunks(chunk)) read_values();
    return make_terrain(std::move(grid_), file_, progress_);
  }

 private:
  struct Entry {
    std::string_view key;
    std::optional<double> value = std::nullopt;
  };

  double* find(std::string_view key) {
    for (Entry& entry : entries_)
      if (entry.key == key) return entry.value ? &*entry.value : nullptr;
    return nullptr;
  }

  double needed(std::string_view key) {
    if (const double* value = find(key)) return *value;
    scanner_.fail("the header of an ESRI ASCII grid ends here, and it has no " + std::string(key));
  }

  bool next_word() { return !scanner_.at_line_end() || scanner_.next_line(); }

  /// Words and their numbers, in any order and case, up to the first number without a word.
  void read_header() {
    for (;;) {
      if (!next_word()) scanner_.fail_at_end("within the header of an ESRI ASCII grid");
      const std::string key = lowered(std::string(scanner_.peek_word().substr(0, kLongestKey)));
      const char first = key.front();
      if ((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.' || key == "nan")
        break;
      read_entry(key);
    }
    const double columns = needed("ncols");
    const double rows = needed("nrows");
    grid_.columns = count(columns, "ncols");
    grid_.rows = count(rows, "nrows");
    check_grid_size(grid_.columns, grid_.rows, file_);
    const auto room = static_cast<std::size_t>(bytes_.data() + bytes_.size() - scanner_.peek_word().data());
    if (grid_.columns * grid_.rows > (room + 1) / 2)
      scanner_.fail("the header announces " + std::to_string(grid_.columns * grid_.rows) +
                    " values, but the file is too short for them");
    const double dx = cell_side("dx");
    const double dy = cell_side("dy");
    const double left = first_centre("xllcorner", "xllcenter", dx);
    const double bottom = first_centre("yllcorner", "yllcenter", dy);
    grid_.first = {left, bottom + static_cast<double>(grid_.rows - 1) * dy};
    grid_.along_row = {dx, 0};
    grid_.to_next_row = {0, -dy};
    if (const double* value = find("nodata_value")) no_data_ = *value;
  }

  void read_entry(std::string key) {
    if (key.ends_with("centre")) key = key.substr(0, key.size() - 2) + "er";
    if (key == "nodata") key = "nodata_value";
    if (key == "xdim") key = "dx";
    if (key == "ydim") key = "dy";
    Entry* entry = nullptr;
    for (Entry& known : entries_)
      if (known.key == key) entry = &known;
    if (entry == nullptr)
      scanner_.fail(
          "the header of an ESRI ASCII grid has ncols, nrows, xllcorner, yllcorner, cellsize and "
          "NODATA_value, not " +
          shown(scanner_.peek_word()));
    if (entry->value) scanner_.fail("the header has " + std::string(entry->key) + " twice");
    scanner_.word();
    if (!next_word()) scanner_.fail_at_end("where the value of " + std::string(entry->key) + " should be");
    entry->value = scanner_.number("the value of " + std::string(entry->key));
  }

  std::size_t count(double value, std::string_view key) const {
    if (!(value >= 0) || value != std::floor(value) || value >= kNone)
      scanner_.fail("the header's " + std::string(key) + " is no number of cells");
    return static_cast<std::size_t>(value);
  }

  double cell_side(std::string_view key) {
    const double* own = find(key);
    const double* both = find("cellsize");
    if (own != nullptr && both != nullptr)
      scanner_.fail("the header has both cellsize and " + std::string(key));
    if (own == nullptr && both == nullptr)
      scanner_.fail("the header has neither cellsize nor " + std::string(key));
    const double side = own != nullptr ? *own : *both;
    if (!(side > 0) || !std::isfinite(side))
      scanner_.fail("the header's " + std::string(own != nullptr ? key : "cellsize") + " is not positive");
    return side;
  }

  /// Of the lower left cell.
  double first_centre(std::string_view corner, std::string_view centre, double side) {
    const double* at_corner = find(corner);
    const double* at_centre = find(centre);
    if ((at_corner == nullptr) == (at_centre == nullptr))
      scanner_.fail("the header needs one of " + std::string(corner) + " and " + std::string(centre) +
                    ", and has " + (at_corner == nullptr ? "neither" : "both"));
    const double place = at_corner != nullptr ? *at_corner + side / 2 : *at_centre;
    if (!std::isfinite(place))
      scanner_.fail("the header's " + std::string(at_corner != nullptr ? corner : centre) + " is not finite");
    return place;
  }

  double elevation(double value) const {
    // Programs write the smallest number of a type with fewer digits in cells than in the header.
    const bool is_huge = std::abs(no_data_) > 1e30;
    const bool is_none = value == no_data_ || (is_huge && std::abs(value / no_data_ - 1) < 1e-5);
    return is_none ? std::numeric_limits<double>::quiet_NaN() : value;
  }

  void read_values() {
    const std::string total = std::to_string(grid_.values.size());
    for (std::size_t i = 0; i < grid_.values.size(); ++i) {
      if (!next_word()) scanner_.fail_at_end("after " + std::to_string(i) + " of " + total + " values");
      grid_.values[i] = elevation(scanner_.number("an elevation"));
    }
    if (next_word())
      scanner_.fail("the file goes on after the " + total + " values that its header announces");
  }

  /// False if the text is too short for that or has an error.
  bool read_in_chunks(std::size_t chunk) {
    const std::string_view body =
        bytes_.substr(static_cast<std::size_t>(scanner_.peek_word().data() - bytes_.data()));
    TextScanner::Syntax syntax = kGridSyntax;
    syntax.terminator = scanner_.terminator();
    const std::vector<std::string_view> chunks = line_chunks(body, syntax.terminator, chunk);
    const Progress silent = progress_.unreported();
    const std::vector<std::size_t> before = items_before(
        chunks,
        [&](std::string_view lines) {
          TextScanner scanner(lines, file_, syntax, silent);
          std::size_t count = 0;
          while (!scanner.word_on_any_line().empty()) ++count;
          return count;
        },
        progress_);
    if (chunks.empty() || before.back() != grid_.values.size()) return false;
    std::atomic<bool> failed{false};
    const auto at_once = static_cast<std::size_t>(std::max(16, 4 * thread_count()));  // between reports
    for (std::size_t begin = 0; begin < chunks.size() && !failed; begin += at_once) {
      progress_.update("reading the mesh", static_cast<double>(begin) / static_cast<double>(chunks.size()));
      parallel_for(begin, std::min(chunks.size(), begin + at_once), 1, [&](std::size_t k, std::size_t) {
        try {
          TextScanner scanner(chunks[k], file_, syntax, silent);
          for (std::size_t i = before[k]; i < before[k + 1]; ++i) {
            if (scanner.at_line_end()) scanner.next_line();
            grid_.values[i] = elevation(scanner.number("an elevation"));
          }
        } catch (const BadInput&) {
          failed = true;
        }
      });
    }
    return !failed;
  }

  std::string_view bytes_;
  const std::string& file_;
  const Progress& progress_;
  TextScanner scanner_;
  std::array<Entry, 10> entries_ = {{{"ncols"},
                                     {"nrows"},
                                     {"xllcorner"},
                                     {"xllcenter"},
                                     {"yllcorner"},
                                     {"yllcenter"},
                                     {"cellsize"},
                                     {"dx"},
                                     {"dy"},
                                     {"nodata_value"}}};
  double no_data_ = -9999;  // what the format has where the header says nothing
  ElevationGrid grid_;
};

}  // namespace

LoadedSoup read_asc(std::string_view bytes, const std::string& file, const Progress& progress) {
  return read_asc(bytes, file, progress, kTextChunk);
}

LoadedSoup read_asc(std::string_view bytes, const std::string& file, const Progress& progress,
                    std::size_t chunk) {
  return GridReader(bytes, file, progress).read(chunk);
}

}  // namespace morsel::core
