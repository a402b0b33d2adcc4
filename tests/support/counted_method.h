#pragma once
/// A method of one's own, which iterates and is counted.

#include <cstddef>
#include <memory>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/morse/smoothing/iteration.h"
#include "morsel/tools/study/registry.h"

namespace morsel::test {

struct Counts {
  std::size_t applications = 0;
  std::size_t iterations = 0;
  std::size_t fields = 0;  ///< that were made of iterations
};

/// Each iteration takes half of every value's distance from the input's minimum away. Refers to `counts`.
class CountedMethod : public core::Method {
 public:
  CountedMethod(const morse::StopCriteria& criteria, Counts& counts) : criteria_(criteria), counts_(counts) {}

  core::MethodResult apply(const core::ScalarField& input,
                           const core::MethodContext& context) const override {
    ++counts_.applications;
    morse::IterationControl control(input, criteria_, context);
    std::vector<double> values(input.values().begin(), input.values().end());
    while (control.more()) {
      ++counts_.iterations;
      for (double& value : values) value = (value + input.min()) / 2;
      if (!control.needs_field()) {
        control.skip();
        continue;
      }
      ++counts_.fields;
      control.record(values);
    }
    return control.result({});
  }

  core::MethodTraits traits() const override { return {.iterates = true, .iterates_are_results = true}; }

 private:
  morse::StopCriteria criteria_;
  Counts& counts_;
};

/// What ships with the library, and "counted".
inline tools::Registry registry_with_counted(Counts& counts) {
  tools::Registry registry = tools::Registry::standard();
  registry.add(tools::MethodEntry{"counted", "halves values", [&counts](core::ParameterReader& reader) {
                                    return std::make_unique<CountedMethod>(
                                        morse::read_stop_criteria(reader, 10), counts);
                                  }});
  return registry;
}

}  // namespace morsel::test
