/// Chosen critical points: a wanted number of them that stand out and lie apart.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/request.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::python {
namespace {

PointsHandle choose(const FieldHandle& field, const py::dict& given, const tools::Registry& registry,
                    const py::object& report) {
  const tools::PointsRequest request = points_request(given);
  return compute(report, [&](const core::Progress& progress) {
    const tools::PointsPlan plan = tools::prepare(request, registry);
    const auto made = std::make_shared<const tools::MadePoints>(
        tools::make_points(plan, field->mesh->loaded, made_field(*field), progress));
    return std::make_shared<PointsData>(PointsData{field, request, made});
  });
}

/// An array of what each chosen point has.
template <class Get>
py::array each(const PointsHandle& points, const Get& get) {
  const auto& chosen = points->made->chosen.points;
  std::vector<decltype(get(chosen.front()))> values;
  values.reserve(chosen.size());
  for (const morse::ChosenPoint& point : chosen) values.push_back(get(point));
  return taken(std::move(values));
}

}  // namespace

void add_points(py::module_& m) {
  using Point = morse::ChosenPoint;
  py::class_<PointsData, PointsHandle> type(m, "Points");
  const auto array = [&](const char* name, auto get) {
    type.def_property_readonly(name, [get](const PointsHandle& points) { return each(points, get); });
  };
  array("vertex", [](const Point& p) { return p.candidate.point.vertex; });
  array("type", [](const Point& p) { return static_cast<std::uint8_t>(p.candidate.point.type); });
  array("multiplicity", [](const Point& p) { return p.candidate.point.multiplicity; });
  array("value", [](const Point& p) { return p.candidate.value; });
  array("persistence", [](const Point& p) { return p.candidate.persistence; });
  array("rank", [](const Point& p) { return p.candidate.rank; });
  array("distance", [](const Point& p) { return p.distance; });
  array("source", [](const Point& p) { return static_cast<std::uint8_t>(p.source); });
  type.def_property_readonly("percentile",
                             [](const PointsHandle& p) {
                               if (p->made->has_percentiles)
                                 return view_of(std::span<const double>(p->made->percentiles), p);
                               return taken(std::vector<double>(p->made->chosen.points.size(), std::nan("")));
                             })
      .def_property_readonly("spacing", [](const PointsData& p) { return p.made->chosen.spacing; })
      .def_property_readonly("candidates", [](const PointsData& p) { return p.made->candidates; })
      .def_property_readonly("scale", [](const PointsData& p) { return p.made->scale; })
      .def_property_readonly("note", [](const PointsData& p) { return text(p.made->note); })
      .def_property_readonly("fill_warnings", [](const PointsData& p) {
        return p.made->fill ? texts(p.made->fill->warnings) : py::list();
      });
  m.def("choose_points", &choose);
  m.attr("points_field") = tools::kPointsField;
  m.attr("fill_field") = tools::kFillField;
}

}  // namespace morsel::python
