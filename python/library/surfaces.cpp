/// Surfaces made of surfaces: cut open, and of quads.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "morsel/mscomplex/quads.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/python/library/results.h"
#include "morsel/tools/study/cutting.h"
#include "morsel/tools/study/quadrangulation.h"

namespace morsel::python {
namespace {

using core::Index;

CutHandle cut(const FieldHandle& field, bool shorten, const py::object& report) {
  return compute(report, [&](const core::Progress& progress) {
    return std::make_shared<CutData>(
        CutData{field, shorten, tools::cut_surface(*field->field, shorten, progress)});
  });
}

/// The surface cut open, in numbers of its own.
MeshHandle opened(const CutHandle& cut) {
  const core::TriangleMesh& mesh = cut->made.opened.mesh;
  return std::make_shared<MeshData>(MeshData{{mesh, {{mesh.vertex_count(), {}, {}}, {}, {}}}, {}, false});
}

/// Per vertex of the opened mesh: the one that it is, or copies.
py::array originals(const CutHandle& cut) {
  std::vector<Index> numbers(cut->made.opened.mesh.vertex_count());
  for (Index v = 0; v < numbers.size(); ++v) numbers[v] = cut->made.opened.original(v);
  return taken(std::move(numbers));
}

py::list paths(const CutHandle& cut) {
  py::list list;
  for (const mscomplex::CutPath& path : cut->made.cut.paths)
    list.append(view_of(std::span<const Index>(path.vertices), cut));
  return list;
}

QuadsHandle quads(const FieldHandle& field, const std::string& persistence, Index resolution, int relaxation,
                  const py::object& report) {
  const tools::QuadRequest request{persistence, resolution, relaxation};
  const tools::QuadPlan plan = tools::prepare(request);
  return compute(report, [&](const core::Progress& progress) {
    return std::make_shared<QuadsData>(
        QuadsData{field, request, tools::quadrangulate(*field->field, plan, progress)});
  });
}

py::dict quality(const QuadsHandle& quads) {
  const mscomplex::QuadQuality& q = quads->made.quality;
  py::dict result;
  result["valence"] = py::cast(q.valence);
  result["extraordinary"] = q.extraordinary;
  result["angle_mean"] = q.angle_mean;
  result["angle_max"] = q.angle_max;
  result["scaled_jacobian_mean"] = q.scaled_jacobian_mean;
  result["scaled_jacobian_min"] = q.scaled_jacobian_min;
  result["concave"] = q.concave;
  result["area_mean"] = q.area_mean;
  result["area_deviation"] = q.area_deviation;
  result["area_min"] = q.area_min;
  result["area_max"] = q.area_max;
  result["distance_max"] = q.distance_max;
  result["distance_mean"] = q.distance_mean;
  result["distance_from_input"] = q.distance_from_input;
  return result;
}

void add_quads(py::module_& m) {
  using mscomplex::DanglingRepair;
  PYBIND11_NUMPY_DTYPE(DanglingRepair, kind, vertex, saddle_vertex, persistence);
  py::class_<QuadsData, QuadsHandle>(m, "Quads")
      .def_property_readonly("positions",
                             [](const QuadsHandle& q) {
                               return rows_of(std::span<const core::Point>(q->made.mesh.positions), q);
                             })
      .def_property_readonly("faces",
                             [](const QuadsHandle& q) {
                               return rows_of<Index, 4>(
                                   std::span<const std::array<Index, 4>>(q->made.mesh.quads), q);
                             })
      .def_property_readonly(
          "patch",
          [](const QuadsHandle& q) { return view_of(std::span<const Index>(q->made.mesh.patch), q); })
      .def_property_readonly("repairs",
                             [](const QuadsHandle& q) {
                               return view_of(std::span<const DanglingRepair>(q->made.repaired.repairs), q);
                             })
      .def_property_readonly("threshold", [](const QuadsData& q) { return q.made.threshold; })
      .def_property_readonly("cancelled", [](const QuadsData& q) { return q.made.cancelled; })
      .def_property_readonly("resolution", [](const QuadsData& q) { return q.made.mesh.resolution; })
      .def_property_readonly("patch_count", [](const QuadsData& q) { return q.made.layout.patches.size(); })
      .def("complex",
           [](const QuadsHandle& q) {
             return complex_handle({q, &q->made.repaired.complex});
           })
      .def("description",
           [](const QuadsHandle& q) {
             return text(tools::described(q->made, q->field->mesh->mesh().bounding_box().diagonal()));
           })
      .def("quality", &quality);
  m.def("quads", &quads);
  m.attr("quads_field") = tools::kQuadField;
}

}  // namespace

void add_surfaces(py::module_& m) {
  using tools::ComponentCut;
  PYBIND11_NUMPY_DTYPE(ComponentCut, vertices, genus, loops, paths, length_found, length, copies);
  py::class_<CutData, CutHandle>(m, "Cut")
      .def("opened", &opened)
      .def("originals", &originals)
      .def("paths", &paths)
      .def_property_readonly(
          "edges", [](const CutHandle& c) { return view_of(std::span<const Index>(c->made.cut.edges), c); })
      .def_property_readonly(
          "components",
          [](const CutHandle& c) { return view_of(std::span<const ComponentCut>(c->made.components), c); })
      .def_property_readonly("length", [](const CutData& c) { return c.made.cut.length; })
      .def_property_readonly("length_found", [](const CutData& c) { return c.made.length_found; })
      .def_property_readonly("attempts", [](const CutData& c) { return c.made.attempts; })
      .def_property_readonly("replaced", [](const CutData& c) { return c.made.replaced; })
      .def_property_readonly("is_settled", [](const CutData& c) { return c.made.is_settled; });
  m.def("cut", &cut);
  m.attr("cut_field") = tools::kCutField;
  add_quads(m);
}

}  // namespace morsel::python
