#include "morsel/core/io/elevation_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

/// The squares around a sample, as bits and in turn: two in succession share a side.
enum Around { kNorthEast, kSouthEast, kSouthWest, kNorthWest };

/// How the triangles around a sample are joined to fans.
struct Fans {
  std::uint8_t count = 0;
  std::array<std::uint8_t, 4> of = {};  ///< by square; of squares without triangles, 0
};

/// `ring` has a bit for each neighbour that has data, in turn from the north on: N, NE, E, SE, S, SW, W, NW.
/// The square k lies between the neighbours 2k and 2k + 2.
constexpr Fans fans_of(unsigned ring) {
  const auto has = [ring](unsigned k) { return (ring >> (k % 8) & 1) != 0; };
  std::array<std::uint8_t, 4> joined = {0, 1, 2, 3};
  std::array<bool, 4> filled = {};
  for (unsigned k = 0; k < 4; ++k) filled[k] = has(2 * k) + has(2 * k + 1) + has(2 * k + 2) >= 2;
  for (unsigned k = 0; k < 4; ++k) {
    const unsigned next = (k + 1) % 4;
    // A filled square has a triangle at each of its sides that have data at both ends.
    if (!filled[k] || !filled[next] || !has(2 * k + 2)) continue;
    const std::uint8_t from = joined[next];
    for (std::uint8_t& fan : joined)
      if (fan == from) fan = joined[k];
  }
  Fans fans;
  std::array<bool, 4> seen = {};
  std::array<std::uint8_t, 4> number = {};
  for (const unsigned k : {kNorthWest, kNorthEast, kSouthWest, kSouthEast}) {  // as triangles are numbered
    if (!filled[k]) continue;
    if (!seen[joined[k]]) {
      seen[joined[k]] = true;
      number[joined[k]] = fans.count++;
    }
    fans.of[k] = number[joined[k]];
  }
  return fans;
}

constexpr std::array<Fans, 256> all_fans() {
  std::array<Fans, 256> fans;
  for (unsigned ring = 0; ring < 256; ++ring) fans[ring] = fans_of(ring);
  return fans;
}
constexpr std::array<Fans, 256> kFans = all_fans();

class Terrain {
 public:
  Terrain(ElevationGrid grid, const std::string& file, const Progress& progress)
      : grid_(std::move(grid)), file_(file), progress_(progress) {}

  LoadedSoup make() {
    check_steps();
    classify_samples();
    number_samples();
    make_vertices();
    make_triangles();
    warn();
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kRows = 8;  // of a chunk: the same for every number of threads

  bool has_data(std::size_t row, std::size_t column) const {
    return !std::isnan(grid_.values[row * grid_.columns + column]);
  }

  /// Bits of the neighbours that have data; those beyond the grid have none.
  unsigned ring(std::size_t row, std::size_t column) const {
    const bool up = row > 0, down = row + 1 < grid_.rows;
    const bool left = column > 0, right = column + 1 < grid_.columns;
    unsigned bits = 0;
    const auto set = [&](unsigned bit, bool exists, std::size_t r, std::size_t c) {
      if (exists && has_data(r, c)) bits |= 1u << bit;
    };
    set(0, up, row - 1, column);
    set(1, up && right, row - 1, column + 1);
    set(2, right, row, column + 1);
    set(3, down && right, row + 1, column + 1);
    set(4, down, row + 1, column);
    set(5, down && left, row + 1, column - 1);
    set(6, left, row, column - 1);
    set(7, up && left, row - 1, column - 1);
    return bits;
  }

  double area() const {
    const auto& a = grid_.along_row;
    const auto& d = grid_.to_next_row;
    return a.x() * d.y() - a.y() * d.x();
  }

  void check_steps() const {
    if (!std::isfinite(area()) || area() == 0)
      fail_reading(file_, "its cells have no area: the steps along a row and to the next row are (" +
                              std::to_string(grid_.along_row.x()) + ", " +
                              std::to_string(grid_.along_row.y()) + ") and (" +
                              std::to_string(grid_.to_next_row.x()) + ", " +
                              std::to_string(grid_.to_next_row.y()) + ")");
  }

  struct Count {
    std::size_t vertices = 0;   ///< samples of this row that a triangle uses
    std::size_t copies = 0;     ///< of samples that are split
    std::size_t triangles = 0;  ///< of the squares below this row
    std::size_t empty = 0;      ///< samples without data
    std::size_t split = 0;
    std::size_t infinite =
        std::numeric_limits<std::size_t>::max();  ///< the first column of an infinite value
  };

  template <class Body>
  void for_each_row(std::size_t rows, const Body& body) const {
    parallel_for(0, rows, kRows, [&](std::size_t first, std::size_t last) {
      progress_.throw_if_cancelled();
      for (std::size_t row = first; row < last; ++row) body(row);
    });
  }

  void classify_samples() {
    progress_.update("making the terrain", 0);
    fans_.resize(grid_.values.size());
    rows_.resize(grid_.rows);
    for_each_row(grid_.rows, [&](std::size_t row) {
      Count count;
      for (std::size_t column = 0; column < grid_.columns; ++column) {
        const double value = grid_.values[row * grid_.columns + column];
        std::uint8_t fans = 0;
        if (std::isinf(value)) {
          count.infinite = std::min(count.infinite, column);
        } else if (std::isnan(value)) {
          ++count.empty;
        } else {
          fans = kFans[ring(row, column)].count;
          if (fans > 0) ++count.vertices;
          if (fans > 1) ++count.split, count.copies += fans - 1u;
        }
        fans_[row * grid_.columns + column] = fans;
        if (row + 1 < grid_.rows && column + 1 < grid_.columns) count.triangles += triangles_at(row, column);
      }
      rows_[row] = count;
    });
    for (std::size_t row = 0; row < grid_.rows; ++row)
      if (rows_[row].infinite < grid_.columns)
        fail_reading(file_, "the value in row " + std::to_string(row + 1) + " and column " +
                                std::to_string(rows_[row].infinite + 1) + " is infinite");
  }

  /// Triangles of the square whose upper left sample this is.
  std::size_t triangles_at(std::size_t row, std::size_t column) const {
    const int samples = has_data(row, column) + has_data(row, column + 1) + has_data(row + 1, column) +
                        has_data(row + 1, column + 1);
    return samples < 3 ? 0 : static_cast<std::size_t>(samples - 2);
  }

  /// Turns the counts of each row into the numbers before it, and counts all.
  void number_samples() {
    for (Count& row : rows_) {
      const Count count = row;
      row.vertices = total_.vertices;
      row.copies = total_.copies;
      row.triangles = total_.triangles;
      row.split = total_.split;
      total_.vertices += count.vertices;
      total_.copies += count.copies;
      total_.triangles += count.triangles;
      total_.empty += count.empty;
      total_.split += count.split;
    }
    if (total_.triangles == 0)
      fail_reading(file_, "none of its squares of " + std::to_string(grid_.rows) + " × " +
                              std::to_string(grid_.columns) +
                              " cells has data at three corners, so that there is no triangle");
    // All samples have numbers then, and check_grid_size() was called for them.
    if (total_.vertices + total_.copies >= kNone)
      fail_reading(file_, "it has more vertices than can be numbered");
  }

  void make_vertices() {
    progress_.update("making the terrain", 0.3);
    number_.resize(grid_.values.size());
    auto& positions = result_.soup.positions;
    positions.resize(total_.vertices + total_.copies);
    splits_.resize(total_.split);
    for_each_row(grid_.rows, [&](std::size_t row) {
      std::size_t next = rows_[row].vertices;
      std::size_t copy = total_.vertices + rows_[row].copies;
      std::size_t split = rows_[row].split;
      for (std::size_t column = 0; column < grid_.columns; ++column) {
        const std::size_t sample = row * grid_.columns + column;
        number_[sample] = static_cast<Index>(next);
        if (fans_[sample] == 0) continue;
        const ElevationGrid::Step place = grid_.first + static_cast<double>(column) * grid_.along_row +
                                          static_cast<double>(row) * grid_.to_next_row;
        const Point position(place.x(), place.y(), grid_.values[sample]);
        positions[next++] = position;
        if (fans_[sample] == 1) continue;
        splits_[split++] = {sample, static_cast<Index>(copy)};
        for (unsigned fan = 1; fan < fans_[sample]; ++fan) positions[copy++] = position;
      }
    });
  }

  /// The vertex of a sample for the triangles of the square `around` it.
  Index vertex(std::size_t row, std::size_t column, Around around) const {
    const std::size_t sample = row * grid_.columns + column;
    if (fans_[sample] == 1) return number_[sample];
    const std::uint8_t fan = kFans[ring(row, column)].of[around];
    if (fan == 0) return number_[sample];
    return std::ranges::lower_bound(splits_, sample, {}, &Split::sample)->first_copy + fan - 1u;
  }

  void make_triangles() {
    progress_.update("making the terrain", 0.6);
    const bool turned = area() > 0;  // rows go up, so that what is counter-clockwise below is not
    PolygonSoup& soup = result_.soup;
    soup.corners.resize(3 * total_.triangles);
    soup.offsets.resize(total_.triangles + 1);
    for_each_row(grid_.rows - 1, [&](std::size_t row) {
      std::size_t next = rows_[row].triangles;
      const auto add = [&](Index a, Index b, Index c) {
        if (turned) std::swap(b, c);
        soup.corners[3 * next] = a;
        soup.corners[3 * next + 1] = b;
        soup.corners[3 * next + 2] = c;
        soup.offsets[next + 1] = 3 * (next + 1);
        ++next;
      };
      for (std::size_t column = 0; column + 1 < grid_.columns; ++column) {
        if (triangles_at(row, column) == 0) continue;
        const auto north_west = [&] { return vertex(row, column, kSouthEast); };
        const auto north_east = [&] { return vertex(row, column + 1, kSouthWest); };
        const auto south_west = [&] { return vertex(row + 1, column, kNorthEast); };
        const auto south_east = [&] { return vertex(row + 1, column + 1, kNorthWest); };
        if (!has_data(row, column)) {
          add(south_west(), south_east(), north_east());
        } else if (!has_data(row + 1, column + 1)) {
          add(north_west(), south_west(), north_east());
        } else {
          if (has_data(row + 1, column)) add(north_west(), south_west(), south_east());
          if (has_data(row, column + 1)) add(north_west(), south_east(), north_east());
        }
      }
    });
    number_ = {};
    make_property();
  }

  /// The elevations by vertex; where every sample is one, the grid's own array.
  void make_property() {
    std::vector<double> elevations = std::move(grid_.values);
    const auto& positions = result_.soup.positions;
    if (positions.size() != elevations.size() || total_.vertices != elevations.size()) {
      elevations = std::vector<double>(positions.size());
      parallel_for_each(positions.size(), [&](std::size_t v) { elevations[v] = positions[v].z(); });
    }
    result_.properties.push_back({"elevation", std::move(elevations)});
  }

  void warn() {
    const std::size_t cells = grid_.columns * grid_.rows;
    const std::size_t alone = cells - total_.empty - total_.vertices;
    if (total_.empty > 0 || alone > 0) {
      std::string sentence = std::to_string(total_.empty) + " of " + std::to_string(cells) +
                             " cells have no data and are left out";
      if (alone > 0)
        sentence += ", and with them " + std::to_string(alone) +
                    " that no triangle reaches: a triangle needs "
                    "three cells of a square of four";
      result_.warnings.push_back(std::move(sentence));
    }
    if (total_.split > 0)
      result_.warnings.push_back(std::to_string(total_.split) +
                                 (total_.split == 1
                                      ? " cell where gaps meet at a corner was split: it became "
                                      : " cells where gaps meet at a corner were split: they "
                                        "became ") +
                                 std::to_string(total_.split + total_.copies) +
                                 " vertices, as the surface is joined at a point there");
    if (grid_.in_degrees)
      result_.warnings.push_back(
          "its positions are longitudes and latitudes in degrees, but elevations are "
          "lengths, so that distances, areas, slopes and curvatures mean nothing: "
          "project it first (gdalwarp -t_srs)");
    else
      warn_of_scale();
  }

  /// Grids in degrees need not say so, but their heights are a thousand times their widths.
  void warn_of_scale() {
    const auto& positions = result_.soup.positions;
    double low = positions.front().z(), high = low;
    for (const Point& p : positions) low = std::min(low, p.z()), high = std::max(high, p.z());
    const double width = std::hypot(static_cast<double>(grid_.columns) * grid_.along_row.norm(),
                                    static_cast<double>(grid_.rows) * grid_.to_next_row.norm());
    if (high - low <= 10 * width) return;
    result_.warnings.push_back(
        "its elevations range over more than ten times its width, as if its positions "
        "were degrees and its elevations metres: then distances, areas, slopes and "
        "curvatures mean nothing; project it first (gdalwarp -t_srs)");
  }

  ElevationGrid grid_;
  const std::string& file_;
  const Progress& progress_;
  std::vector<std::uint8_t> fans_;  // by sample; 0: no vertex
  std::vector<Index> number_;       // by sample: the vertex of its first fan
  struct Split {
    std::size_t sample = 0;
    Index first_copy = 0;
  };
  std::vector<Split> splits_;  // by sample
  std::vector<Count> rows_;    // before each row, once they are summed up
  Count total_;
  LoadedSoup result_;
};

}  // namespace

void check_grid_size(std::size_t columns, std::size_t rows, const std::string& file) {
  if (columns < 2 || rows < 2)
    fail_reading(file, "a terrain needs two rows and two columns at least, and this one has " +
                           std::to_string(rows) + (rows == 1 ? " row and " : " rows and ") +
                           std::to_string(columns) + (columns == 1 ? " column" : " columns"));
  if (columns >= kNone / rows)
    fail_reading(file, "its " + std::to_string(rows) + " rows and " + std::to_string(columns) +
                           " columns have more cells than vertices can be numbered");
}

LoadedSoup make_terrain(ElevationGrid grid, const std::string& file, const Progress& progress) {
  return Terrain(std::move(grid), file, progress).make();
}

}  // namespace morsel::core
