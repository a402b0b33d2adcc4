#include "support/salient_reference.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <utility>

namespace morsel::test {

struct SalientListing::Search {
  struct Cloud {
    std::span<const core::Point> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, core::Index>;

  /// Keeps of `found` what can be reached from v within it.
  void keep_connected(core::Index v) {
    const auto distance = [&](core::Index u) {
      return std::find_if(found.begin(), found.end(), [&](const auto& x) { return x.first == u; });
    };
    std::vector<std::pair<core::Index, double>> reached = {*distance(v)};
    std::vector<core::Index> ring;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      options.connected_by->neighbors(reached[i].first, ring);
      for (const core::Index u : ring) {
        const bool is_new =
            std::none_of(reached.begin(), reached.end(), [&](const auto& x) { return x.first == u; });
        if (is_new && distance(u) != found.end()) reached.push_back(*distance(u));
      }
    }
    found = std::move(reached);
  }

  Search(std::span<const core::Point> points, const SalientReferenceOptions& o)
      : cloud{points}, tree(3, cloud), options(o) {}
  Cloud cloud;
  Tree tree;
  SalientReferenceOptions options;
  std::vector<std::pair<core::Index, double>> found;
};

SalientListing::SalientListing(std::span<const core::Point> positions, const SalientReferenceOptions& options)
    : search_(std::make_unique<Search>(positions, options)) {}
SalientListing::~SalientListing() = default;

double SalientListing::saliency(std::span<const double> values, core::Index v, std::size_t* pairs) {
  auto& [cloud, tree, options, found] = *search_;
  const double radius = options.support * options.sigma;
  const double two_sigma_squared = 2 * options.sigma * options.sigma;
  // The search is strict, the neighbourhood is not: search slightly further, then compare distances.
  tree.radiusSearch(cloud.points[v].data(), radius * radius * (1 + 1e-9), found,
                    nanoflann::SearchParams(32, 0, false));
  const double surely_inside =
      radius * radius * (1 - 1e-12);  // a root for every pair would slow the baseline down
  std::erase_if(found,
                [&](const auto& x) { return x.second > surely_inside && std::sqrt(x.second) > radius; });
  if (options.connected_by != nullptr) search_->keep_connected(v);
  if (pairs != nullptr) *pairs += found.size();
  double sigma_s = options.sigma_s.value_or(0);
  if (!options.sigma_s)
    for (const auto& [x, squared] : found) sigma_s = std::max(sigma_s, std::abs(values[x] - values[v]));
  if (sigma_s == 0) return 0;
  double numerator = 0;
  double denominator = 0;
  for (const auto& [x, squared] : found) {
    const double difference = values[x] - values[v];
    const double t = difference / sigma_s;
    double weight = std::exp(-squared / two_sigma_squared) * std::exp(-t * t / 2);
    if (!options.weights.empty()) weight *= options.weights[x];
    numerator += difference * weight;
    denominator += weight;
  }
  return denominator > 0 ? numerator / denominator : 0;
}

std::vector<double> salient_reference(std::span<const core::Point> positions, std::vector<double> values,
                                      const SalientReferenceOptions& options, std::vector<double>* saliency) {
  SalientListing listing(positions, options);
  std::vector<double> s(values.size(), 0.0);
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    for (std::size_t v = 0; v < values.size(); ++v)
      s[v] = listing.saliency(values, static_cast<core::Index>(v));
    for (std::size_t v = 0; v < values.size(); ++v) values[v] += s[v];
  }
  if (saliency != nullptr) *saliency = std::move(s);
  return values;
}

}  // namespace morsel::test
