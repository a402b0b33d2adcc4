#include "morsel/morse/smoothing/iteration.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/smoothing/keep_order.h"

namespace morsel::morse {
namespace {

using core::InvalidArgument;

constexpr int kMostIterations = 1'000'000;
constexpr int kIterationsWithCondition = 1000;

double largest_change(std::span<const double> before, std::span<const double> after) {
  return core::parallel_reduce(
      0, after.size(), core::kGrain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double most = 0;
        for (std::size_t v = first; v < last; ++v) most = std::max(most, std::abs(after[v] - before[v]));
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
}

bool same_counts(const core::IterationRecord& a, const core::IterationRecord& b) {
  return a.minima == b.minima && a.saddles == b.saddles && a.saddle_multiplicity == b.saddle_multiplicity &&
         a.maxima == b.maxima;
}

void check(const StopCriteria& criteria) {
  if (criteria.iterations < 0)
    throw InvalidArgument("a method cannot run " + std::to_string(criteria.iterations) + " iterations");
  if (criteria.until_stable && *criteria.until_stable < 2)
    throw InvalidArgument("until-stable must be at least 2, not " + std::to_string(*criteria.until_stable));
  if (criteria.until_change && !(*criteria.until_change >= 0 && *criteria.until_change <= 1))
    throw InvalidArgument("until-change must be between 0 and 1, not " +
                          core::shortest(*criteria.until_change));
}

/// Empty for "none", else the text as read by `parse`.
template <class Parse>
auto optional_value(core::ParameterReader& reader, const char* key, const char* description,
                    const Parse& parse) -> std::optional<decltype(parse(std::string(), std::string()))> {
  const std::string text = reader.text(key, "none", description);
  if (text == "none") return std::nullopt;
  return parse(text, reader.owner() + ":" + key);
}

std::int64_t parse_at_least(std::int64_t min, const std::string& text, const std::string& what) {
  const std::int64_t number = core::parse_integer(text, what);
  if (number < min || number > std::int64_t{1} << 30)
    throw InvalidArgument(what + " must be a whole number from " + std::to_string(min) + " on, not " + text);
  return number;
}

}  // namespace

StopCriteria read_stop_criteria(core::ParameterReader& reader, int iterations) {
  StopCriteria criteria;
  criteria.iterations = static_cast<int>(
      reader.count(core::kIterationsKey, iterations, 0, kMostIterations,
                   "how many iterations at most (1000 if another condition is given and this is not)"));
  criteria.until_count =
      optional_value(reader, "until-count", "stop as soon as at most so many critical points are left",
                     [](const std::string& text, const std::string& what) {
                       return static_cast<std::size_t>(parse_at_least(0, text, what));
                     });
  criteria.until_stable =
      optional_value(reader, "until-stable", "stop as soon as so many successive fields have the same counts",
                     [](const std::string& text, const std::string& what) {
                       return static_cast<int>(parse_at_least(2, text, what));
                     });
  criteria.until_change = optional_value(
      reader, "until-change", "stop as soon as no value changes by more than this share of the field's range",
      [](const std::string& text, const std::string& what) {
        const double share = core::parse_number(text, what);
        if (!(share >= 0 && share <= 1))
          throw InvalidArgument(what + " must be between 0 and 1, not " + text);
        return share;
      });
  const bool conditions = criteria.until_count || criteria.until_stable || criteria.until_change;
  if (conditions && !reader.given(core::kIterationsKey)) criteria.iterations = kIterationsWithCondition;
  return criteria;
}

core::Parameters to_parameters(const StopCriteria& criteria) {
  core::Parameters parameters = {{std::string(core::kIterationsKey), std::int64_t{criteria.iterations}}};
  if (criteria.until_count)
    parameters.emplace_back("until_count", static_cast<std::int64_t>(*criteria.until_count));
  if (criteria.until_stable) parameters.emplace_back("until_stable", std::int64_t{*criteria.until_stable});
  if (criteria.until_change) parameters.emplace_back("until_change", *criteria.until_change);
  return parameters;
}

IterationControl::IterationControl(const core::ScalarField& input, const StopCriteria& criteria,
                                   const core::MethodContext& context, Start start)
    : input_(input), criteria_(criteria), context_(context), start_(start), field_(input) {
  check(criteria);
  restart();
}

bool IterationControl::counted() const {
  return context_.count_iterations || criteria_.until_count || criteria_.until_stable;
}

bool IterationControl::needs_field() const {
  const int next = iteration_ + 1;
  return counted() || criteria_.until_change || next >= criteria_.iterations ||
         context_.on_iteration.wants(next);
}

void IterationControl::restart() {
  field_ = input_;
  iteration_ = 0;
  stopped_by_ = {};
  records_.clear();
  count(0);
  decide(0);
  if (start_ == Start::made) tell();
}

void IterationControl::record(std::vector<double> values) {
  core::ScalarField next = keep_order(input_, std::move(values));
  const double change = largest_change(field_.values(), next.values());
  field_ = std::move(next);
  ++iteration_;
  count(change);
  decide(change);
  tell();
}

void IterationControl::tell() {
  const bool go_on = context_.on_iteration(iteration_, field_);
  if (!go_on && stopped_by_.empty()) stopped_by_ = "caller";
}

void IterationControl::count(double change) {
  if (!counted()) return;
  const CriticalPoints points = classify(field_, context_.progress.unreported());
  records_.push_back(
      {iteration_, points.minima, points.saddles, points.saddle_multiplicity, points.maxima, change});
}

void IterationControl::decide(double change) {
  const auto stable = [&](std::size_t fields) {
    return records_.size() >= fields &&
           std::all_of(records_.end() - static_cast<std::ptrdiff_t>(fields), records_.end(),
                       [&](const auto& r) { return same_counts(r, records_.back()); });
  };
  if (criteria_.until_count && records_.back().total() <= *criteria_.until_count)
    stopped_by_ = "until-count";
  else if (criteria_.until_stable && stable(static_cast<std::size_t>(*criteria_.until_stable)))
    stopped_by_ = "until-stable";
  else if (criteria_.until_change && iteration_ > 0 && change <= *criteria_.until_change * input_.extent())
    stopped_by_ = "until-change";
  else if (iteration_ >= criteria_.iterations)
    stopped_by_ = "iterations";
}

core::MethodResult IterationControl::result(core::Parameters parameters, core::Parameters details) const {
  core::Parameters all = to_parameters(criteria_);
  all.insert(all.end(), std::make_move_iterator(parameters.begin()),
             std::make_move_iterator(parameters.end()));
  details.emplace_back("iterations_run", std::int64_t{iteration_});
  details.emplace_back("stopped_by", std::string(stopped_by_));
  return {field_, std::move(all), std::move(details), records_,
          core::IterationEnd{iteration_, std::string(stopped_by_)}};
}

}  // namespace morsel::morse
