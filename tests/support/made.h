#pragma once
/// Morse functions and methods made of keys, as the command line makes them.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/field/method.h"

namespace morsel::test {

using Given = std::vector<std::pair<std::string, std::string>>;

/// What `make` makes of the keys; throws as the command line does if one is wrong or unknown.
template <class Made>
std::unique_ptr<Made> made(std::unique_ptr<Made> (*make)(core::ParameterReader&), const std::string& name,
                           Given given = {}) {
  core::ParameterReader reader({name, std::move(given)});
  std::unique_ptr<Made> result = make(reader);
  reader.finish();
  return result;
}

/// A copy, to compare.
inline std::vector<double> values_of(const core::ScalarField& field) {
  return {field.values().begin(), field.values().end()};
}

}  // namespace morsel::test
