#include "morsel/core/io/face_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/interruptible.h"

namespace morsel::core {
namespace {

std::string free_name(std::string name, const std::vector<VertexProperty>& taken) {
  while (std::ranges::find(taken, name, &VertexProperty::name) != taken.end()) name.insert(0, "face:");
  return name;
}

/// Calls visit(p, v) for each polygon and each of its vertices, once.
template <class Visit>
void for_each_incidence(const PolygonSoup& soup, const std::vector<Index>& representative,
                        const Visit& visit) {
  std::vector<Index> vertices;
  for (std::size_t p = 0; p < soup.polygon_count(); ++p) {
    throw_if_stopped_at_times();
    vertices.clear();
    for (const Index v : soup.polygon(p)) vertices.push_back(representative[v]);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const Index v : vertices) visit(p, v);
  }
}

}  // namespace

std::vector<VertexProperty> face_values_at_vertices(const LoadedSoup& file,
                                                    const std::vector<Index>& representative) {
  std::vector<VertexProperty> result;
  if (file.face_properties.empty()) return result;
  const PolygonSoup& soup = file.soup;
  const std::size_t count = soup.positions.size();
  std::vector<double> areas(soup.polygon_count());
  for (std::size_t p = 0; p < areas.size(); ++p) {
    const double area = soup.area(p);
    areas[p] = std::isfinite(area) ? area : 0;
  }
  std::vector<double> whole(count, 0);
  for_each_incidence(soup, representative, [&](std::size_t p, Index v) { whole[v] += areas[p]; });
  std::vector<VertexProperty> taken = file.properties;
  for (const VertexProperty& property : file.face_properties) {
    if (property.values.size() != areas.size())
      throw InvalidArgument("the property " + property.name + " has " +
                            std::to_string(property.values.size()) + " values for " +
                            std::to_string(areas.size()) + " faces");
    std::vector<double> sums(count, 0);
    std::vector<double> weights(count, 0);
    for_each_incidence(soup, representative, [&](std::size_t p, Index v) {
      const double weight = whole[v] > 0 ? areas[p] : 1;
      if (weight == 0) return;
      sums[v] += weight * property.values[p];
      weights[v] += weight;
    });
    VertexProperty& made =
        result.emplace_back(VertexProperty{free_name(property.name, taken), std::vector<double>(count)});
    for (std::size_t v = 0; v < count; ++v) {
      const Index r = representative[v];
      made.values[v] = weights[r] > 0 ? sums[r] / weights[r] : std::numeric_limits<double>::quiet_NaN();
    }
    taken.push_back({made.name, {}});
  }
  return result;
}

}  // namespace morsel::core
