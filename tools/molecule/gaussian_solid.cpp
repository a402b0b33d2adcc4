#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/tools/molecule/solid.h"

namespace morsel::tools {
namespace {

constexpr double kNegligible = 1e-7;

/// Outside and far from all balls.
constexpr double kOutside = 1e3;

class GaussianSolid final : public Solid {
 public:
  GaussianSolid(std::vector<Ball> balls, double blobbiness)
      : balls_(std::move(balls)), blobbiness_(blobbiness), most_(1 - std::log(kNegligible) / blobbiness) {
    double sum = 0;
    for (const Ball& ball : balls_) {
      reach_ = std::max(reach_, ball.radius * std::sqrt(most_));
      sum += ball.radius;
    }
    mean_radius_ = sum / static_cast<double>(balls_.size());
  }

  double reach() const override { return reach_; }

  /// Around a single ball of radius r the density is exp(B (1 − d²/r²)); its inverse d/r − 1, times a typical
  /// r, is about a length wherever the surface passes.
  void evaluate(std::span<const core::Point> places, std::span<const core::Index> balls,
                std::span<double> values) const override {
    for (std::size_t k = 0; k < places.size(); ++k) {
      double density = 0;
      for (const core::Index i : balls) {
        const double r = balls_[i].radius;
        const double square = (places[k] - balls_[i].center).squaredNorm() / (r * r);
        if (square < most_) density += std::exp(blobbiness_ * (1 - square));
      }
      values[k] = density > 0
                      ? mean_radius_ * (std::sqrt(std::max(0.0, 1 - std::log(density) / blobbiness_)) - 1)
                      : kOutside;
    }
  }

 private:
  std::vector<Ball> balls_;
  double blobbiness_;
  double most_;  // the largest d²/r² of a term that counts
  double mean_radius_ = 0;
  double reach_ = 0;
};

}  // namespace

std::unique_ptr<Solid> gaussian_solid(std::vector<Ball> balls, double blobbiness) {
  return std::make_unique<GaussianSolid>(std::move(balls), blobbiness);
}

}  // namespace morsel::tools
