#include "morsel/morse/smoothing/ball_keys.h"

namespace morsel::morse {

void read_sigma(core::ParameterReader& reader, SalientOptions& options) {
  options.sigma =
      reader.length("sigma", options.sigma, core::kPositive, "standard deviation of the weight of distances");
}

void read_support(core::ParameterReader& reader, SalientOptions& options) {
  options.support = reader.number("support", options.support, core::kPositive,
                                  "radius of the neighbourhood, in multiples of sigma");
}

void read_neighbors(core::ParameterReader& reader, SalientOptions& options) {
  if (reader.choice("weights", "none", {"none", "area"},
                    "area: a neighbour counts with its vertex area, so that sampling matters less") == "area")
    options.weights = NeighborWeights::area;
  if (reader.choice("ball", "euclidean", {"euclidean", "connected"},
                    "connected: only neighbours that edges within the neighbourhood connect") == "connected")
    options.ball = Ball::connected;
}

}  // namespace morsel::morse
