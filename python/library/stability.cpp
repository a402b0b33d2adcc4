/// Stability of critical points on perturbed surfaces.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/request.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/tools/study/presets.h"
#include "morsel/tools/study/stability.h"

namespace morsel::python {
namespace {

using tools::StabilityRequest;

/// What a dict gives of a request.
StabilityRequest request_of(const py::dict& given) {
  StabilityRequest request;
  const RequestReader reader(given);
  reader.take("target", request.target);  // which presets depend on
  std::optional<std::string> preset;
  reader.take("preset", preset);
  if (preset) tools::apply_preset(*preset, request);
  reader.take("fields", request.fields);
  reader.take("methods", request.methods);
  reader.take("noise", request.noise);
  reader.take("decimate", request.decimate);
  reader.take("subdivide", request.subdivide);
  reader.take("trials", request.trials);
  reader.take("seed", request.seed);
  reader.take("radius", request.radius);
  reader.take("reference_field", request.reference_field);
  reader.take("reference", request.reference);
  reader.choose("kind", request.noise_kind,
                std::array{tools::NoiseKind::normal, tools::NoiseKind::isotropic});
  reader.choose("points", request.points, std::array{tools::PointChoice::all, tools::PointChoice::extrema});
  return request;
}

StabilityHandle stability(const MeshHandle& mesh, const FieldHandle& values, const py::dict& given,
                          const tools::Registry& registry, const py::object& report) {
  StabilityRequest request = request_of(given);
  FieldHandle field;
  if (values) {
    StudyField of = compute(py::none(), [&](const core::Progress&) { return study_field(values); });
    request.fields = {std::move(of.text)};
    field = std::move(of.values);
  }
  tools::StabilityPlan plan = tools::prepare(request, registry);
  return compute(report, [&](const core::Progress& progress) {
    auto data = std::make_shared<StabilityData>(
        StabilityData{{mesh, field}, tools::with_defaults(request), std::move(plan), {}});
    data->result = tools::run_stability(data->input.loaded(), data->plan, progress);
    return data;
  });
}

/// (mean, half width of the confidence interval, count)
py::tuple estimate(const tools::Estimate& of) {
  return py::make_tuple(of.mean, of.half_width ? py::cast(*of.half_width) : py::none(), of.count);
}

/// A dict for each outcome and perturbation.
py::list rows(const StabilityHandle& stability) {
  py::list list;
  for (const tools::StabilityOutcome& outcome : stability->result.outcomes)
    for (const tools::PerturbationOutcome& p : outcome.perturbations) {
      py::dict row;
      row["field"] = text(stability->request.fields[outcome.field]);
      row["method"] = text(stability->request.methods[outcome.method]);
      row["target"] = outcome.target ? py::cast(*outcome.target) : py::none();
      row["perturbation"] = text(tools::to_string(p.perturbation.kind));
      row["amount"] = p.perturbation.amount;
      row["trials"] = p.trials.size();
      row["clean"] = outcome.points.total();
      row["agreement"] = outcome.agreement();
      row["recall"] = estimate(p.recall());
      row["precision"] = estimate(p.precision());
      row["f_score"] = estimate(p.f_score());
      row["chance"] = estimate(p.chance());
      row["drift"] = estimate(p.drift());
      row["found"] = estimate(p.found());
      list.append(row);
    }
  return list;
}

}  // namespace

void add_stability(py::module_& m) {
  py::class_<StabilityData, StabilityHandle>(m, "Stability")
      .def("rows", &rows)
      .def_property_readonly("values", [](const StabilityData& s) { return s.input.values; })
      .def_property_readonly("mesh", [](const StabilityData& s) { return s.input.mesh; })
      .def_property_readonly("field_texts", [](const StabilityData& s) { return texts(s.request.fields); })
      .def_property_readonly("seed", [](const StabilityData& s) { return s.request.seed; })
      .def_property_readonly("radius", [](const StabilityData& s) { return s.result.radius; })
      .def_property_readonly("mean_edge_length",
                             [](const StabilityData& s) { return s.result.mean_edge_length; })
      .def("warnings", [](const StabilityHandle& s) {
        py::list list;
        for (const tools::FieldOutcome& field : s->result.fields)
          list.append(py::make_tuple(text(field.name), texts(field.warnings)));
        list.append(py::make_tuple("stability", texts(s->result.warnings())));
        return list;
      });
  m.def("stability", &stability);
}

}  // namespace morsel::python
