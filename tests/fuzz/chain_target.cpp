#include <cmath>
#include <string>

#include "morsel/core/error.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/study/registry.h"
#include "morsel/tools/study/variation.h"
#include "target.h"

namespace {

using namespace morsel;

/// What `make` makes of a text, and again of what it calls itself; nothing if it refuses the text.
template <class Make>
void check(const Make& make) {
  try {
    make();
  } catch (const core::InvalidArgument& error) {
    fuzz::require(error.what()[0] != '\0', "an error says what is wrong");
  }
}

void check_method(std::string_view text) {
  const tools::MethodChain chain = tools::Registry::standard().make_method(text);
  fuzz::require(!chain.steps.empty(), "a chain without a step");
  std::string name;
  for (const tools::MethodStep& step : chain.steps) {
    fuzz::require(step.method != nullptr, "a step without a method");
    name.append(name.empty() ? "" : "+").append(step.name);
  }
  fuzz::require(name == chain.name, "the name of a chain");
  fuzz::require(tools::Registry::standard().make_method(chain.specification).name == chain.name,
                "a chain made again");
}

void check_function(std::string_view text) {
  const tools::NamedFunction function = tools::Registry::standard().make_function(text);
  fuzz::require(function.function != nullptr, "a name without a function");
  fuzz::require(tools::Registry::standard().make_function(function.specification).name == function.name,
                "a function made again");
}

void check_variation(std::string_view text) {
  const tools::Variation variation = tools::parse_variation(text);
  fuzz::require(
      !variation.key.empty() && !variation.values.empty() && variation.values.size() <= tools::kMostValues,
      "a variation without key or values");
  std::string unit;
  const std::vector<double> numbers = tools::numbers_of(variation.values, unit);
  fuzz::require(numbers.empty() || numbers.size() == variation.values.size(), "numbers of some values");
}

}  // namespace

void morsel::fuzz::chain(std::string_view bytes) {
  const std::string text(bytes);
  check([&] { check_method(text); });
  check([&] { check_function(text); });
  check([&] { check_variation(text); });
  check([&] {
    const tools::render::Size size = tools::render::parse_size(text);
    require(size.width > 0 && size.height > 0, "the size of a picture");
  });
  check([&] { require(tools::render::parse_inset(text).vertex >= 0, "the vertex of an inset"); });
  check([&] { tools::render::CameraText{.view = text, .inset = text}.check(); });
}
