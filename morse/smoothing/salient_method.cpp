// The method "salient": keys, iterations, what is reported.

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/morse/operators/low_pass.h"
#include "morsel/morse/smoothing/ball_keys.h"
#include "morsel/morse/smoothing/empty_balls.h"
#include "morsel/morse/smoothing/iteration.h"
#include "morsel/morse/smoothing/keep_order.h"
#include "morsel/morse/smoothing/salient.h"
#include "morsel/morse/smoothing/salient_iterations.h"

namespace morsel::morse {
namespace {

std::string to_string(Precision precision) { return precision == Precision::float64 ? "double" : "single"; }

/// The keys' defaults, under a name.
struct Preset {
  std::string_view name;
  int iterations;
  core::Length sigma;
  const char* range;
  core::Length scale;
};

constexpr Preset kPaper = {"paper", 10, core::Length::epsilons(8), "1std", core::Length::absolute(0)};
constexpr Preset kRobust = {"robust", 1, core::Length::edges(1), "0.2std", core::Length::edges(1.8)};

class Salient final : public core::Method {
 public:
  Salient(SalientOptions options, const StopCriteria& criteria, core::Length scale, std::string_view preset)
      : options_(std::move(options)), criteria_(criteria), scale_(scale), preset_(preset) {}

  core::MethodResult apply(const core::ScalarField& given,
                           const core::MethodContext& context) const override {
    const core::ScalarField input = retakes() ? at_scale(given, context) : given;
    IterationControl control(input, criteria_, context, retakes() ? Start::made : Start::given);
    SalientResult salient = run_salient(input, options_, criteria_, control, context.progress);
    core::Parameters parameters = {{"sigma", salient.sigma},
                                   {"range", to_string(options_.range)},
                                   {"support", options_.support},
                                   {"classify", options_.return_saliency ? "saliency" : "smoothed"},
                                   {"precision", to_string(options_.precision)},
                                   {"accuracy", options_.accuracy},
                                   {"weights", std::string(to_string(options_.weights))},
                                   {"ball", std::string(to_string(options_.ball))}};
    if (preset_ != kPaper.name) parameters.emplace_back("preset", std::string(preset_));
    if (retakes()) parameters.emplace_back("scale", scale_.on(given.mesh()));
    if (salient.sigma_s) parameters.emplace_back("sigma_s", *salient.sigma_s);
    core::Parameters details = {
        {"pairs_per_iteration", static_cast<std::int64_t>(salient.pairs)},
        {"algorithm", salient.algorithm == SalientAlgorithm::exact ? "exact" : "near-linear"},
        {"promised_error", salient.promised_error}};
    if (salient.estimated_error > 0 && std::isfinite(salient.estimated_error))
      details.emplace_back("estimated_error", salient.estimated_error);
    if (!salient.reason.empty()) details.emplace_back("exact_because", salient.reason);
    core::MethodResult result = control.result(std::move(parameters), std::move(details));
    result.field = std::move(salient.field);
    result.sigma = salient.sigma;
    result.warnings = empty_ball_warnings(given.mesh(), options_.support * salient.sigma);
    return result;
  }

  /// Not the increment; and whether the near-linear algorithm gives way depends on the iterations to come.
  core::MethodTraits traits() const override {
    return {.reevaluates_function = retakes(),
            .iterates = true,
            .iterates_are_results = !options_.return_saliency && options_.accuracy == 0,
            .returns_other = options_.return_saliency};
  }

 private:
  bool retakes() const { return scale_.value > 0; }

  /// The Morse function of the smoothed surface, as a field on the original one.
  core::ScalarField at_scale(const core::ScalarField& given, const core::MethodContext& context) const {
    if (!context.morse_function)
      throw core::InvalidArgument(
          "salient with a scale evaluates the Morse function on the smoothed surface, but this field has "
          "none");
    const core::TriangleMesh surface = low_pass(given.mesh(), scale_, context.progress);
    try {
      const core::ScalarField field = context.morse_function(surface);
      return keep_order(given, {field.values().begin(), field.values().end()});
    } catch (const core::BadInput& error) {
      throw core::BadInput("on the surface smoothed to a scale of " + core::to_string(scale_) + ": " +
                           error.what());
    }
  }

  SalientOptions options_;
  StopCriteria criteria_;
  core::Length scale_;
  std::string_view preset_;
};

}  // namespace

std::unique_ptr<core::Method> make_salient(core::ParameterReader& reader) {
  const bool robust =
      reader.choice(
          "preset", kPaper.name, {kPaper.name, kRobust.name},
          "the defaults of the other keys: the paper's, or those measured as robust on noisy surfaces") ==
      kRobust.name;
  const Preset& preset = robust ? kRobust : kPaper;
  SalientOptions options;
  options.sigma = preset.sigma;
  const StopCriteria criteria = read_stop_criteria(reader, preset.iterations);
  options.iterations = criteria.iterations;
  read_sigma(reader, options);
  options.range = parse_value_range(
      reader.text("range", preset.range,
                  "standard deviation of the weight of values: a multiple of "
                  "the field's (1std), local, literal (sigma), none (no limit), or a number"),
      reader.owner() + ":range");
  read_support(reader, options);
  options.return_saliency = reader.choice("classify", "smoothed", {"smoothed", "saliency"},
                                          "the field to return: f, or the last S instead") == "saliency";
  if (reader.choice(
          "precision", "double", {"double", "single"},
          "of weights and sums; single is faster, up to 2e-6 of the field's range off after 10 iterations") ==
      "single")
    options.precision = Precision::float32;
  options.accuracy = reader.number(
      "accuracy", 0, {0, false, 1},
      "share of the field's range by which the result may be off, so that large meshes take less time; 0 for "
      "an exact result");
  read_neighbors(reader, options);
  const core::Length scale = read_scale(reader, preset.scale);
  check(options);
  return std::make_unique<Salient>(std::move(options), criteria, scale, preset.name);
}

}  // namespace morsel::morse
