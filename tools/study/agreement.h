#pragma once
/// How far two sets of points agree.

#include <cstddef>
#include <optional>

namespace morsel::tools {

/// Number of random placements whose mean is a chance level.
inline constexpr std::size_t kPlacements = 10;

/// part / whole; of nothing all is right: 1 if there is no whole.
inline double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? 1 : static_cast<double>(part) / static_cast<double>(whole);
}

/// The agreement of reference points with those found, matched one to one.
struct Agreement {
  std::size_t reference = 0;
  std::size_t found = 0;
  std::size_t matched = 0;
  double distances = 0;  ///< of matched points, their sum
  bool is_least = true;  ///< no other matching of as many points has a smaller sum

  double recall() const { return ratio(matched, reference); }  ///< in stability: the repeatability
  double precision() const { return ratio(matched, found); }
  /// The harmonic mean of both.
  double f_score() const { return ratio(2 * matched, reference + found); }
  /// The mean distance of matched points, in the mesh's unit.
  std::optional<double> drift() const {
    if (matched == 0) return {};
    return distances / static_cast<double>(matched);
  }
};

}  // namespace morsel::tools
