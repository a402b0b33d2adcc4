#include "morsel/morse/smoothing/gaussian.h"

#include <string>
#include <utility>

#include "morsel/morse/smoothing/ball_keys.h"
#include "morsel/morse/smoothing/empty_balls.h"
#include "morsel/morse/smoothing/salient_iterations.h"

namespace morsel::morse {
namespace {

SalientOptions without_range() {
  SalientOptions options;
  options.iterations = 1;
  options.range = {ValueRange::Kind::none, 1};
  options.step = "Gaussian smoothing";
  return options;
}

class Gaussian final : public core::Method {
 public:
  Gaussian(SalientOptions options, const StopCriteria& criteria)
      : options_(std::move(options)), criteria_(criteria) {}

  core::MethodResult apply(const core::ScalarField& input,
                           const core::MethodContext& context) const override {
    IterationControl control(input, criteria_, context);
    const SalientResult averaged = run_salient(input, options_, criteria_, control, context.progress);
    core::MethodResult result =
        control.result({{"sigma", averaged.sigma},
                        {"support", options_.support},
                        {"weights", std::string(to_string(options_.weights))},
                        {"ball", std::string(to_string(options_.ball))}},
                       {{"pairs_per_iteration", static_cast<std::int64_t>(averaged.pairs)}});
    result.sigma = averaged.sigma;
    result.warnings = empty_ball_warnings(input.mesh(), options_.support * averaged.sigma);
    return result;
  }

  core::MethodTraits traits() const override { return {.iterates = true, .iterates_are_results = true}; }

 private:
  SalientOptions options_;
  StopCriteria criteria_;
};

}  // namespace

core::ScalarField gaussian(const core::ScalarField& input, const GaussianOptions& options,
                           const core::Progress& progress) {
  SalientOptions salient_options = without_range();
  salient_options.iterations = options.iterations;
  salient_options.sigma = options.sigma;
  salient_options.support = options.support;
  salient_options.weights = options.weights;
  salient_options.ball = options.ball;
  return salient(input, salient_options, progress).field;
}

std::unique_ptr<core::Method> make_gaussian(core::ParameterReader& reader) {
  SalientOptions options = without_range();
  const StopCriteria criteria = read_stop_criteria(reader, options.iterations);
  read_sigma(reader, options);
  read_support(reader, options);
  read_neighbors(reader, options);
  check(options);
  return std::make_unique<Gaussian>(std::move(options), criteria);
}

}  // namespace morsel::morse
