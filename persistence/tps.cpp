/// Persistence cancellation as a method that is chosen by name.

#include <cstdint>
#include <limits>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/persistence/cancellation.h"

namespace morsel::persistence {
namespace {

class Tps final : public core::Method {
 public:
  explicit Tps(const CancellationOptions& options) : options_(options) {}

  core::MethodResult apply(const core::ScalarField& input,
                           const core::MethodContext& context) const override {
    CancellationResult result = cancel(input, options_, context.progress);
    core::Parameters parameters;
    if (options_.count) {
      parameters.emplace_back("count", static_cast<std::int64_t>(*options_.count));
    } else {
      parameters.emplace_back("threshold", options_.threshold.on(input));
      if (options_.threshold.in_percent)
        parameters.emplace_back("threshold_percent", options_.threshold.value);
    }
    core::Parameters details;
    details.emplace_back("cancelled_pairs", static_cast<std::int64_t>(result.cancelled_pairs));
    details.emplace_back("largest_cancelled", result.largest_cancelled);
    details.emplace_back("reached_count", static_cast<std::int64_t>(result.reached_count));
    if (!result.note.empty()) details.emplace_back("note", std::move(result.note));
    return {std::move(result.field), std::move(parameters), std::move(details)};
  }

  core::MethodTraits traits() const override { return {.cancels_pairs = true}; }

 private:
  CancellationOptions options_;
};

std::size_t read_count(const std::string& text, const std::string& what) {
  const bool is_name = text.find_first_not_of("0123456789+-.") != std::string::npos;
  if (is_name)
    throw core::InvalidArgument(what + " must be a whole number, not \"" + text +
                                "\": a method's name stands for a number in a comparison alone");
  const std::int64_t number = core::parse_integer(text, what);
  if (number < 1) throw core::InvalidArgument(what + " must be at least 1, not " + std::to_string(number));
  return static_cast<std::size_t>(number);
}

}  // namespace

std::unique_ptr<core::Method> make_tps(core::ParameterReader& reader) {
  CancellationOptions options;
  const std::string threshold = reader.text(
      "threshold", "0.1%",
      "cancel pairs up to this persistence: a percentage of the field's range, or a number in the "
      "field's unit");
  const std::string count = reader.text(
      "count", "none",
      "cancel down to this number of critical points, instead of a threshold; in a comparison the "
      "name of an earlier method stands for the number that it leaves");
  const std::string& owner = reader.owner();
  options.threshold = parse_threshold(threshold, owner + ":threshold");
  if (count != "none") {
    if (reader.given("threshold")) throw core::InvalidArgument(owner + " takes threshold or count, not both");
    options.count = read_count(count, owner + ":count");
  }
  return std::make_unique<Tps>(options);
}

}  // namespace morsel::persistence
