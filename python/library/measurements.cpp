/// Critical points, persistence, chosen thresholds: what is measured on one field.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <utility>
#include <vector>

#include "morsel/morse/critical_points.h"
#include "morsel/persistence/diagram.h"
#include "morsel/persistence/pairing.h"
#include "morsel/persistence/threshold.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/library/module.h"
#include "morsel/python/library/results.h"

namespace morsel::python {
namespace {

using morse::CriticalPoint;
using morse::CriticalPoints;
using persistence::Diagram;
using persistence::EssentialExtrema;
using persistence::EssentialSaddle;
using persistence::PersistencePair;

py::array critical_points(const FieldHandle& field, const py::object& report) {
  return points_array(compute(report, [&](const core::Progress& progress) {
    return std::make_shared<const CriticalPoints>(morse::classify(*field->field, progress));
  }));
}

DiagramHandle persistence_of(const FieldHandle& field, const py::object& report) {
  return compute(report, [&](const core::Progress& progress) {
    return diagram_handle(
        std::make_shared<const Diagram>(persistence::pair_extrema(*field->field, progress)));
  });
}

/// Per vertex.
py::array vertex_persistence(const DiagramHandle& diagram, core::Index vertex_count) {
  return taken(persistence::vertex_persistence(*diagram->diagram, vertex_count));
}

/// Birth and death of each pair, (k, 2), in the memory of the pairs.
py::array birth_death(const DiagramHandle& diagram) {
  const std::vector<PersistencePair>& pairs = diagram->diagram->pairs;
  static_assert(offsetof(PersistencePair, death) == offsetof(PersistencePair, birth) + sizeof(double));
  const void* const first = pairs.empty() ? nullptr : &pairs.front().birth;
  return view_of(py::dtype::of<double>(), {static_cast<py::ssize_t>(pairs.size()), 2},
                 {sizeof(PersistencePair), sizeof(double)}, first, diagram->diagram);
}

}  // namespace

void add_pairs(py::dict& result, const tools::PersistenceSummary& pairs) {
  result["pairs"] = pairs.pairs;
  for (std::size_t i = 0; i < pairs.above.size(); ++i)
    result[py::str("above_" + core::shortest(pairs.kPercents[i]) + "_percent")] = pairs.above[i];
}

py::array points_array(const std::shared_ptr<const CriticalPoints>& points) {
  return view_of(std::span<const CriticalPoint>(points->points), points);
}

DiagramHandle diagram_handle(std::shared_ptr<const Diagram> diagram) {
  return std::make_shared<DiagramData>(DiagramData{std::move(diagram)});
}

void add_measurements(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(CriticalPoint, vertex, type, multiplicity);
  PYBIND11_NUMPY_DTYPE(PersistencePair, extremum, saddle, kind, birth, death);
  PYBIND11_NUMPY_DTYPE(EssentialExtrema, minimum, top, top_is_cap);
  PYBIND11_NUMPY_DTYPE(EssentialSaddle, vertex, count);
  py::class_<DiagramData, DiagramHandle>(m, "Diagram")
      .def_property_readonly("pairs",
                             [](const DiagramData& d) {
                               return view_of(std::span<const PersistencePair>(d.diagram->pairs), d.diagram);
                             })
      .def_property_readonly("birth_death", &birth_death)
      .def_property_readonly("finite_count", [](const DiagramData& d) { return d.diagram->finite_count; })
      .def_property_readonly("essential_extrema",
                             [](const DiagramData& d) {
                               return view_of(std::span<const EssentialExtrema>(d.diagram->essential_extrema),
                                              d.diagram);
                             })
      .def_property_readonly("essential_saddles",
                             [](const DiagramData& d) {
                               return view_of(std::span<const EssentialSaddle>(d.diagram->essential_saddles),
                                              d.diagram);
                             })
      .def("vertex_persistence", &vertex_persistence);
  m.def("critical_points", &critical_points);
  m.def("persistence", &persistence_of);
  m.def("threshold", [](const FieldHandle& field, const std::string& threshold) {
    return persistence::parse_threshold(threshold, "the threshold").on(*field->field);
  });
}

}  // namespace morsel::python
