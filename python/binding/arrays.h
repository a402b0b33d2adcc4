#pragma once
/// numpy's arrays: views of the library's memory, and copies of the caller's.

#include <pybind11/numpy.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/types.h"

namespace morsel::python {

namespace py = pybind11;

/// Keeps alive what an array refers to.
using Owner = std::shared_ptr<const void>;

/// An array that refers to memory of `owner` and cannot be written to. `shape` and `strides` (in bytes) as
/// numpy's.
py::array view_of(const py::dtype& type, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                  const void* data, Owner owner);

/// The same of a row of values: (n,).
template <class T>
py::array view_of(std::span<const T> values, Owner owner) {
  return view_of(py::dtype::of<T>(), {static_cast<py::ssize_t>(values.size())}, {sizeof(T)}, values.data(),
                 std::move(owner));
}

/// Rows of `Columns` numbers of type T each: (n, Columns).
template <class T, int Columns, class Row>
py::array rows_of(std::span<const Row> rows, Owner owner) {
  static_assert(sizeof(Row) == Columns * sizeof(T));
  return view_of(py::dtype::of<T>(), {static_cast<py::ssize_t>(rows.size()), Columns},
                 {sizeof(Row), sizeof(T)}, rows.data(), std::move(owner));
}
inline py::array rows_of(std::span<const core::Point> points, Owner owner) {
  return rows_of<double, 3>(points, std::move(owner));
}

/// The array of a vector that is moved to it.
template <class Vector>
py::array taken(Vector values) {
  using T = typename Vector::value_type;
  const auto kept = std::make_shared<const Vector>(std::move(values));
  return view_of<T>(std::span<const T>(*kept), kept);
}
template <class Vector>
py::array taken_points(Vector points) {
  const auto kept = std::make_shared<const Vector>(std::move(points));
  return rows_of(std::span<const core::Point>(*kept), kept);
}

/// Copies of arrays of any numbers, in any layout. They throw ValueError, naming the array as `what`, for
/// other shapes and types: complex numbers, texts, objects, truth values, and where they are not whole
/// numbers that an Index can hold, the first such element.
std::vector<core::Point> points_from(const py::array& array, const char* what);
std::vector<double> values_from(const py::array& array, const char* what);
std::vector<core::Index> indices_from(const py::array& array, const char* what);
/// Triangles, from an array (m, 3).
std::vector<core::Triangle> triangles_from(const py::array& faces);
/// Faces of three or more corners each, from an array (m, corners).
core::PolygonSoup soup_from(const py::array& positions, const py::array& faces);

}  // namespace morsel::python
