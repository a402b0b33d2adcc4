/// Morse-Smale complexes as arrays.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <utility>

#include "morsel/mscomplex/arrays.h"
#include "morsel/mscomplex/quad_regions.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/library/module.h"
#include "morsel/python/library/results.h"

namespace morsel::python {
namespace {

using core::Index;
using mscomplex::MorseSmaleComplex;
using mscomplex::Segmentation;

ComplexHandle complex_of(const FieldHandle& field, const py::object& report) {
  return compute(report, [&](const core::Progress& progress) {
    return complex_handle(std::make_shared<const MorseSmaleComplex>(*field->field, progress));
  });
}

template <class Make>
py::array array_of(const ComplexHandle& complex, const Make& make) {
  return taken(compute(py::none(), [&](const core::Progress&) { return make(*complex->complex); }));
}

/// (points, offsets)
py::tuple polylines(const ComplexHandle& complex, const py::object& report) {
  mscomplex::Polylines lines = compute(report, [&](const core::Progress& progress) {
    return mscomplex::polylines_of(*complex->complex, progress);
  });
  return py::make_tuple(taken_points(std::move(lines.points)), taken(std::move(lines.offsets)));
}

/// The arcs around a node, counter-clockwise.
py::array arcs_around(const ComplexHandle& complex, Index node) {
  if (node >= complex->complex->node_count())
    throw py::index_error("the complex has " + std::to_string(complex->complex->node_count()) +
                          " nodes; there is no node " + std::to_string(node));
  std::vector<Index> arcs;
  complex->complex->for_each_arc_around(node, [&](Index arc) { arcs.push_back(arc); });
  return taken(std::move(arcs));
}

py::dict segmentation_of(const FieldHandle& field, const ComplexHandle& complex, const py::object& report) {
  return segmentation_dict(compute(report, [&](const core::Progress& progress) {
    return std::make_shared<const Segmentation>(
        mscomplex::segment(*field->field, complex->complex->gradient(), progress));
  }));
}

/// Quads that have area.
Index cell_count(const FieldHandle& field, const ComplexHandle& complex) {
  return compute(py::none(), [&](const core::Progress&) {
    return mscomplex::cell_count(*field->field, *complex->complex);
  });
}

}  // namespace

ComplexHandle complex_handle(std::shared_ptr<const MorseSmaleComplex> complex) {
  return std::make_shared<ComplexData>(ComplexData{std::move(complex)});
}

py::dict segmentation_dict(const std::shared_ptr<const Segmentation>& segmentation) {
  const auto labels = [&](const mscomplex::SegmentLabels& of) {
    return py::make_tuple(view_of(std::span<const Index>(of.vertex), segmentation),
                          view_of(std::span<const Index>(of.triangle), segmentation), of.count);
  };
  py::dict result;
  result["ascending"] = labels(segmentation->ascending);
  result["descending"] = labels(segmentation->descending);
  result["morse_smale"] = labels(segmentation->morse_smale);
  result["cells"] =
      rows_of<Index, 2>(std::span<const std::array<Index, 2>>(segmentation->cells), segmentation);
  return result;
}

void add_complex(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(mscomplex::Node, kind, cell, vertex, value);
  PYBIND11_NUMPY_DTYPE(mscomplex::Arc, saddle, end, kind);
  PYBIND11_NUMPY_DTYPE(mscomplex::Quad, nodes, arcs);
  const auto count = [](auto get) { return [get](const ComplexData& c) { return get(*c.complex); }; };
  py::class_<ComplexData, ComplexHandle>(m, "Complex")
      .def("nodes", [](const ComplexHandle& c) { return array_of(c, mscomplex::nodes_of); })
      .def("arcs", [](const ComplexHandle& c) { return array_of(c, mscomplex::arcs_of); })
      .def("quads", [](const ComplexHandle& c) { return array_of(c, mscomplex::quads_of); })
      .def("polylines", &polylines)
      .def("arcs_around", &arcs_around)
      .def_property_readonly("minimum_count", count([](const auto& c) { return c.minimum_count(); }))
      .def_property_readonly("saddle_count", count([](const auto& c) { return c.saddle_count(); }))
      .def_property_readonly("maximum_count", count([](const auto& c) { return c.maximum_count(); }))
      .def_property_readonly("cap_count", count([](const auto& c) { return c.cap_count(); }));
  m.def("complex", &complex_of);
  m.def("segmentation", &segmentation_of);
  m.def("cell_count", &cell_count);
}

}  // namespace morsel::python
