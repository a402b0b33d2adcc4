/// Segments as arrays.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/text/nearest_name.h"
#include "morsel/persistence/threshold.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/python/library/results.h"

namespace morsel::python {
namespace {

using core::Index;
using mscomplex::Segment;
using mscomplex::SegmentNeighbour;
using mscomplex::Segments;

mscomplex::SegmentKind kind_of(const std::string& by) {
  std::vector<std::string> names;
  for (const mscomplex::SegmentKind kind : mscomplex::kSegmentKinds) {
    names.push_back(mscomplex::to_string(kind));
    if (by == names.back()) return kind;
  }
  throw core::InvalidArgument("by " + core::must_be_one_of(names, by));
}

SegmentsHandle segment(const FieldHandle& field, const std::string& by, std::optional<std::size_t> segments,
                       const std::optional<std::string>& threshold, const py::object& report) {
  tools::SegmentRequest request{kind_of(by), segments, {}};
  if (threshold) request.persistence = persistence::parse_threshold(*threshold, "persistence");
  tools::check(request);
  return compute(report, [&](const core::Progress& progress) {
    return std::make_shared<SegmentsData>(
        SegmentsData{field, request, tools::make_segments(*field->field, request, progress)});
  });
}

/// An array in the memory of the segments.
template <class T>
auto part(const std::vector<T> Segments::*member) {
  return
      [member](const SegmentsHandle& s) { return view_of(std::span<const T>(s->made.segments.*member), s); };
}

/// Of each segment the vertex of its minimum, or of its maximum or cap; kNone if it has none.
py::array vertices_of(const SegmentsHandle& s, Index Segment::*node) {
  const mscomplex::MorseSmaleComplex& complex = s->made.hierarchy.complex();
  std::vector<Index> vertices;
  for (const Segment& one : s->made.segments.segments)
    vertices.push_back(one.*node == core::kNone ? core::kNone : complex.node(one.*node).vertex);
  return taken(std::move(vertices));
}

}  // namespace

void add_segments(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Segment, minimum, top, triangles, vertices, area, boundary_length,
                       mesh_boundary_length);
  PYBIND11_NUMPY_DTYPE(SegmentNeighbour, segment, edges, length);
  py::class_<SegmentsData, SegmentsHandle>(m, "Segments")
      .def_property_readonly("by", [](const SegmentsData& s) { return mscomplex::to_string(s.request.kind); })
      .def_property_readonly("vertex", part(&Segments::vertex))
      .def_property_readonly("face", part(&Segments::triangle))
      .def_property_readonly("table", part(&Segments::segments))
      .def_property_readonly("neighbour_offsets", part(&Segments::neighbour_offset))
      .def_property_readonly("neighbours", part(&Segments::neighbour))
      .def_property_readonly("saddle_offsets", part(&Segments::saddle_offset))
      .def_property_readonly("saddles", part(&Segments::saddle))
      .def_property_readonly("level", [](const SegmentsData& s) { return s.made.segments.level; })
      .def_property_readonly("unmerged", [](const SegmentsData& s) { return s.made.unmerged; })
      .def_property_readonly("cancelled_pairs", [](const SegmentsData& s) { return s.made.cancelled_pairs; })
      .def_property_readonly("largest_persistence",
                             [](const SegmentsData& s) { return s.made.largest_persistence; })
      .def_property_readonly("note", [](const SegmentsData& s) { return text(s.made.note); })
      .def("minima", [](const SegmentsHandle& s) { return vertices_of(s, &Segment::minimum); })
      .def("tops", [](const SegmentsHandle& s) { return vertices_of(s, &Segment::top); });
  m.def("segment", &segment);
}

}  // namespace morsel::python
