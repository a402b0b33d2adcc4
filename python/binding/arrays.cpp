#include "morsel/python/binding/arrays.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

namespace morsel::python {
namespace {

std::string shape_text(const py::array& array) { return py::str(py::tuple(array.attr("shape"))); }
std::string type_text(const py::array& array) { return py::str(array.dtype()); }

[[noreturn]] void refuse(const std::string& text) { throw py::value_error(text); }

template <class T>
bool is_index(T value) {
  return std::cmp_greater_equal(value, 0) && std::cmp_less(value, core::kNone);
}

template <class T>
[[noreturn]] void refuse_index(T value, std::size_t row, const char* what) {
  refuse(std::string(what) + " must be numbers of vertices, from 0 on, not " + std::to_string(value) +
         " (in row " + std::to_string(row) + ")");
}

/// The elements of an array of one or two dimensions in any layout, row by row.
template <class T>
void copy_indices(const py::array& array, core::Index* numbers, const char* what) {
  const auto rows = static_cast<std::size_t>(array.shape(0));
  const auto columns = static_cast<std::size_t>(array.ndim() == 2 ? array.shape(1) : 1);
  const py::ssize_t down = array.strides(0);
  const py::ssize_t across = array.ndim() == 2 ? array.strides(1) : 0;
  const auto* const data = static_cast<const char*>(array.data());
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      T value;
      std::memcpy(&value, data + static_cast<py::ssize_t>(r) * down + static_cast<py::ssize_t>(c) * across,
                  sizeof(T));
      if (!is_index(value)) refuse_index(value, r, what);
      *numbers++ = static_cast<core::Index>(static_cast<std::uint64_t>(value));
    }
}

/// The same of consecutive elements, which takes a fraction of the time.
template <class T>
void copy_consecutive(const py::array& array, core::Index* numbers, const char* what) {
  const auto count = static_cast<std::size_t>(array.size());
  const auto* const data = static_cast<const T*>(array.data());
  // All are indices if the bits that any of them has are: one test, and a loop that compilers vectorize.
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = static_cast<std::uint64_t>(data[i]);
    bits |= value;
    numbers[i] = static_cast<core::Index>(value);
  }
  if (!is_index(bits)) copy_indices<T>(array, numbers, what);  // which looks at each, and names the first
}

template <class T>
void copy(const py::array& array, core::Index* numbers, const char* what) {
  constexpr unsigned kPlain = static_cast<unsigned>(py::array::c_style) |
                              static_cast<unsigned>(py::detail::npy_api::NPY_ARRAY_ALIGNED_);
  if ((static_cast<unsigned>(array.flags()) & kPlain) == kPlain)
    copy_consecutive<T>(array, numbers, what);
  else
    copy_indices<T>(array, numbers, what);
}

using Copy = void (*)(const py::array&, core::Index*, const char*);

/// For elements of a type of at least two bytes, in this machine's byte order; null where these are no whole
/// numbers.
Copy copy_of(const py::dtype& type) {
  constexpr std::array<Copy, 3> kSigned = {&copy<std::int16_t>, &copy<std::int32_t>, &copy<std::int64_t>};
  constexpr std::array<Copy, 3> kUnsigned = {&copy<std::uint16_t>, &copy<std::uint32_t>,
                                             &copy<std::uint64_t>};
  if (type.kind() != 'i' && type.kind() != 'u') return nullptr;
  const auto size = static_cast<std::size_t>(std::bit_width(static_cast<std::size_t>(type.itemsize()))) - 2;
  return (type.kind() == 'i' ? kSigned : kUnsigned).at(size);
}

/// As it is, but in this machine's byte order and not of single bytes.
py::array plain_numbers(const py::array& given) {
  const py::dtype type = given.dtype();
  if ((type.kind() == 'i' || type.kind() == 'u') && type.itemsize() == 1)
    return given.attr("astype")(py::dtype::of<std::int64_t>());
  return type.attr("isnative").cast<bool>() ? given
                                            : py::array(given.attr("astype")(type.attr("newbyteorder")("=")));
}

/// Writes the whole numbers of an array of one or two dimensions, row by row.
void read_indices(const py::array& given, core::Index* numbers, const char* what) {
  const py::array array = plain_numbers(given);
  const Copy copy_elements = copy_of(array.dtype());
  if (copy_elements == nullptr)
    refuse(std::string(what) + " must be whole numbers (such as int32 or int64), not " + type_text(given));
  copy_elements(array, numbers, what);
}

constexpr const char* kCorners = "the corners of the faces";

void check_faces(const py::array& faces) {
  if (faces.ndim() != 2 || faces.shape(1) < 3)
    refuse("the faces must have the shape (m, 3), or (m, k) for polygons of k corners, not " +
           shape_text(faces) + (faces.ndim() == 2 && faces.shape(0) == 3 ? "; transpose them" : ""));
}

using Doubles =
    py::array_t<double, static_cast<int>(py::array::c_style) | static_cast<int>(py::array::forcecast) |
                            static_cast<int>(py::detail::npy_api::NPY_ARRAY_ALIGNED_)>;

/// Doubles, contiguous and aligned, of an array of numbers.
Doubles doubles(const py::array& array, const char* what) {
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    refuse(std::string(what) + " must be real numbers, not " + type_text(array));
  return Doubles(array);
}

}  // namespace

py::array view_of(const py::dtype& type, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                  const void* data, Owner owner) {
  const py::capsule base(new Owner(std::move(owner)), [](void* kept) { delete static_cast<Owner*>(kept); });
  static const double nothing = 0;  // what an array of no elements refers to
  py::array array(type, std::move(shape), std::move(strides), data != nullptr ? data : &nothing, base);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

std::vector<core::Point> points_from(const py::array& array, const char* what) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    refuse(std::string(what) + " must have the shape (n, 3), not " + shape_text(array) +
           (array.ndim() == 2 && array.shape(0) == 3 ? "; transpose them" : ""));
  const Doubles numbers = doubles(array, what);
  std::vector<core::Point> points;
  const auto rows = static_cast<std::size_t>(numbers.shape(0));
  points.reserve(rows);
  const double* const data = numbers.data();
  for (std::size_t i = 0; i < rows; ++i) points.emplace_back(data[3 * i], data[3 * i + 1], data[3 * i + 2]);
  return points;
}

std::vector<double> values_from(const py::array& array, const char* what) {
  if (array.ndim() != 1) refuse(std::string(what) + " must have the shape (n,), not " + shape_text(array));
  const Doubles numbers = doubles(array, what);
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<core::Index> indices_from(const py::array& array, const char* what) {
  if (array.ndim() != 1) refuse(std::string(what) + " must have the shape (n,), not " + shape_text(array));
  std::vector<core::Index> numbers(static_cast<std::size_t>(array.size()));
  read_indices(array, numbers.data(), what);
  return numbers;
}

std::vector<core::Triangle> triangles_from(const py::array& faces) {
  check_faces(faces);
  if (faces.shape(1) != 3) refuse("triangles must have the shape (m, 3), not " + shape_text(faces));
  std::vector<core::Triangle> triangles(static_cast<std::size_t>(faces.shape(0)));
  static_assert(sizeof(core::Triangle) == 3 * sizeof(core::Index));
  read_indices(faces, reinterpret_cast<core::Index*>(triangles.data()), kCorners);
  return triangles;
}

core::PolygonSoup soup_from(const py::array& positions, const py::array& faces) {
  core::PolygonSoup soup;
  soup.positions = points_from(positions, "the vertices");
  check_faces(faces);
  soup.corners.resize(static_cast<std::size_t>(faces.size()));
  read_indices(faces, soup.corners.data(), kCorners);
  const auto corners = static_cast<std::size_t>(faces.shape(1));
  soup.offsets.resize(static_cast<std::size_t>(faces.shape(0)) + 1);
  for (std::size_t i = 0; i < soup.offsets.size(); ++i) soup.offsets[i] = i * corners;
  return soup;
}

}  // namespace morsel::python
