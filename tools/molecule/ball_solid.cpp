#include <algorithm>
#include <limits>
#include <utility>

#include "morsel/tools/molecule/solid.h"

namespace morsel::tools {
namespace {

class BallSolid final : public Solid {
 public:
  explicit BallSolid(std::vector<Ball> balls) : balls_(std::move(balls)) {
    for (const Ball& ball : balls_) largest_ = std::max(largest_, ball.radius);
  }

  double reach() const override { return largest_; }

  void evaluate(std::span<const core::Point> places, std::span<const core::Index> balls,
                std::span<double> values) const override {
    for (std::size_t k = 0; k < places.size(); ++k) {
      // With no ball within reach the distance is unknown and not needed.
      double least = std::numeric_limits<double>::max();
      for (const core::Index i : balls)
        least = std::min(least, (places[k] - balls_[i].center).norm() - balls_[i].radius);
      values[k] = least;
    }
  }

 private:
  std::vector<Ball> balls_;
  double largest_ = 0;
};

}  // namespace

std::unique_ptr<Solid> ball_solid(std::vector<Ball> balls) {
  return std::make_unique<BallSolid>(std::move(balls));
}

}  // namespace morsel::tools
