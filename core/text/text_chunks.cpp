#include "morsel/core/text/text_chunks.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::core {
namespace {

PolygonSoup joined(std::vector<PolygonSoup>& parts) {
  std::vector<std::size_t> position(parts.size() + 1, 0);
  std::vector<std::size_t> polygon(parts.size() + 1, 0);
  std::vector<std::size_t> corner(parts.size() + 1, 0);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    position[k + 1] = position[k] + parts[k].positions.size();
    polygon[k + 1] = polygon[k] + parts[k].polygon_count();
    corner[k + 1] = corner[k] + parts[k].corners.size();
  }
  PolygonSoup soup;
  soup.positions.resize(position.back());
  soup.offsets.resize(polygon.back() + 1);
  soup.corners.resize(corner.back());
  parallel_for(0, parts.size(), 1, [&](std::size_t k, std::size_t) {
    const PolygonSoup part = std::exchange(parts[k], {});
    std::copy(part.positions.begin(), part.positions.end(), soup.positions.data() + position[k]);
    std::copy(part.corners.begin(), part.corners.end(), soup.corners.data() + corner[k]);
    for (std::size_t p = 0; p < part.polygon_count(); ++p)
      soup.offsets[polygon[k] + p + 1] = corner[k] + part.offsets[p + 1];
  });
  return soup;
}

}  // namespace

std::vector<std::string_view> line_chunks(std::string_view text, char terminator, std::size_t chunk) {
  std::vector<std::string_view> chunks;
  if (text.size() / 2 < chunk || thread_count() == 1) return chunks;
  while (!text.empty()) {
    const std::size_t end = text.size() <= chunk ? std::string_view::npos : text.find(terminator, chunk - 1);
    const std::size_t size = end == std::string_view::npos ? text.size() : end + 1;
    chunks.push_back(text.substr(0, size));
    text.remove_prefix(size);
    if (chunks.back().starts_with("\xEF\xBB\xBF")) return {};
  }
  return chunks;
}

std::vector<std::size_t> items_before(const std::vector<std::string_view>& chunks,
                                      const std::function<std::size_t(std::string_view)>& count,
                                      const Progress& progress) {
  std::vector<std::size_t> before(chunks.size() + 1, 0);
  parallel_for(0, chunks.size(), 1, [&](std::size_t k, std::size_t) {
    progress.throw_if_cancelled();
    before[k + 1] = count(chunks[k]);
  });
  std::partial_sum(before.begin(), before.end(), before.begin());
  return before;
}

std::optional<PolygonSoup> read_chunks(std::size_t chunks,
                                       const std::function<PolygonSoup(std::size_t)>& read,
                                       const Progress& progress) {
  std::vector<PolygonSoup> parts(chunks);
  std::atomic<bool> failed{false};
  const std::size_t at_once = std::max(16, 4 * thread_count());  // between reports of progress
  for (std::size_t begin = 0; begin < chunks && !failed; begin += at_once) {
    progress.update("reading the mesh", static_cast<double>(begin) / static_cast<double>(chunks));
    parallel_for(begin, std::min(chunks, begin + at_once), 1, [&](std::size_t k, std::size_t) {
      try {
        parts[k] = read(k);
      } catch (const BadInput&) {
        failed = true;
      }
    });
  }
  if (failed) return std::nullopt;
  progress.update("reading the mesh", 1);
  return joined(parts);
}

}  // namespace morsel::core
