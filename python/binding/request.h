#pragma once
/// Requests that Python hands over as a dict of what the user gave.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::python {

namespace py = pybind11;

/// Reads members of a dict; what it lacks keeps its default. Throws TypeError, naming the key, on a value of
/// another type, and InvalidArgument on an unknown word and on what is no length.
class RequestReader {
 public:
  explicit RequestReader(py::dict given) : given_(std::move(given)) {}

  template <class T>
  void take(const char* key, T& value) const {
    if (given_.contains(key)) value = cast<T>(key);
  }
  template <class Lengths>  // a Length, or an optional one
  void take_length(const char* key, Lengths& value) const {
    if (given_.contains(key)) value = core::parse_length(cast<std::string>(key), key);
  }
  /// One of the values of `all`, by its word.
  template <class All, class T>
  void choose(const char* key, T& value, const All& all) const {
    if (!given_.contains(key)) return;
    const auto word = cast<std::string>(key);
    std::string listed;
    for (const T one : all) {
      if (word == to_string(one)) {
        value = one;
        return;
      }
      listed += (listed.empty() ? "" : ", ") + std::string(to_string(one));
    }
    throw core::InvalidArgument(std::string(key) + " must be one of " + listed + ", not \"" + word + "\"");
  }

 private:
  template <class T>
  T cast(const char* key) const {
    try {
      return given_[key].template cast<T>();
    } catch (const py::cast_error&) {
      const std::string type = py::str(py::type::of(given_[key]).attr("__name__"));
      throw py::type_error(std::string(key) + " has a value of the wrong type or size, of type " + type);
    }
  }

  py::dict given_;
};

/// How a mesh is made, as users give it.
struct BuildTexts {
  bool repair = false;
  std::optional<std::string> weld = {};  ///< a length within which vertices are joined
  std::optional<std::string> mask = {};  ///< as --mask takes it
};
/// Throws InvalidArgument if `weld` is no length, or negative, or `mask` is none.
core::BuildOptions build_options(const BuildTexts& texts);

/// count, kind, rank, spacing, fill, scale, percentiles.
tools::PointsRequest points_request(const py::dict& given);

}  // namespace morsel::python
