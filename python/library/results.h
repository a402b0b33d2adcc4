#pragma once
/// What several parts of the module hand to Python: critical points, diagrams, complexes, segmentations.

#include <pybind11/numpy.h>

#include <memory>

#include "morsel/morse/critical_points.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/mscomplex/segmentation.h"
#include "morsel/persistence/diagram.h"
#include "morsel/python/binding/data.h"
#include "morsel/tools/study/summary.h"

namespace morsel::python {

namespace py = pybind11;

/// pairs, and above_0.1_percent and the like: how many pairs there are above shares of the field's range.
void add_pairs(py::dict& result, const tools::PersistenceSummary& pairs);

/// Vertex, type and multiplicity of each, in the memory of `points`.
py::array points_array(const std::shared_ptr<const morse::CriticalPoints>& points);

struct DiagramData {
  std::shared_ptr<const persistence::Diagram> diagram;
};
using DiagramHandle = std::shared_ptr<DiagramData>;
DiagramHandle diagram_handle(std::shared_ptr<const persistence::Diagram> diagram);

/// A complex and its nodes, arcs and quads as arrays.
struct ComplexData {
  std::shared_ptr<const mscomplex::MorseSmaleComplex> complex;
};
using ComplexHandle = std::shared_ptr<ComplexData>;
ComplexHandle complex_handle(std::shared_ptr<const mscomplex::MorseSmaleComplex> complex);

/// (vertex labels, triangle labels, count) of the ascending, descending and Morse-Smale segments, by name,
/// and `cells`, in the memory of `segmentation`.
py::dict segmentation_dict(const std::shared_ptr<const mscomplex::Segmentation>& segmentation);

}  // namespace morsel::python
