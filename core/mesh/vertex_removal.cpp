#include "morsel/core/mesh/vertex_removal.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/interruptible.h"
#include "morsel/core/text/numbers.h"

namespace morsel::core {

ReducedSoup leave_out(PolygonSoup soup, const std::vector<bool>& left_out) {
  const std::size_t count = soup.positions.size();
  if (left_out.size() != count)
    throw InvalidArgument("which vertices are left out must be said for each of " + std::to_string(count) +
                          " vertices, not for " + std::to_string(left_out.size()));
  ReducedSoup result;
  result.numbering.input_count = count;
  result.vertex_count = static_cast<std::size_t>(std::ranges::count(left_out, true));
  if (result.vertex_count == 0) {
    result.soup = std::move(soup);
    return result;
  }

  enum Use : std::uint8_t { unused = 0, by_removed = 1, by_kept = 2 };
  std::vector<std::uint8_t> use(count, unused);
  const std::size_t before = soup.polygon_count();
  std::size_t end = 0;  // of the corners that are kept, which never overtake those that are read
  for (std::size_t p = 0, begin = 0; p < before; ++p) {
    throw_if_stopped_at_times();
    const std::size_t size = soup.offsets[p + 1] - begin;
    const std::span<const Index> polygon = std::span<const Index>(soup.corners).subspan(begin, size);
    begin += size;
    const bool goes = std::ranges::any_of(polygon, [&](Index v) { return v < count && left_out[v]; });
    for (const Index v : polygon)
      if (v < count) use[v] |= goes ? by_removed : by_kept;
    if (goes) continue;
    std::ranges::copy(polygon, soup.corners.begin() + static_cast<std::ptrdiff_t>(end));
    end += size;
    result.polygons.push_back(static_cast<Index>(p));
    soup.offsets[result.polygons.size()] = end;
  }
  result.polygon_count = before - result.polygons.size();
  if (result.polygons.empty() && before > 0)
    throw BadInput("no face is left: each of " + grouped(before) + " has a vertex that is left out, as are " +
                   grouped(result.vertex_count) + " of " + grouped(count) + " vertices");
  soup.offsets.resize(result.polygons.size() + 1);
  soup.corners.resize(end);

  std::vector<Index>& number = result.numbering.from_input;
  number.assign(count, kNone);
  for (Index v = 0; v < count; ++v) {
    if (left_out[v]) continue;
    if (use[v] == by_removed) {
      ++result.stranded_count;
      continue;
    }
    const auto kept = static_cast<Index>(result.numbering.to_input.size());
    number[v] = kept;
    soup.positions[kept] = Point(soup.positions[v]);
    result.numbering.to_input.push_back(v);
    result.rim.push_back((use[v] & by_removed) != 0);
  }
  result.vertex_count += result.stranded_count;
  soup.positions.resize(result.numbering.to_input.size());
  // Corners that name no vertex keep doing so.
  for (Index& v : soup.corners) v = v < count ? number[v] : kNone;
  result.soup = std::move(soup);
  return result;
}

}  // namespace morsel::core
