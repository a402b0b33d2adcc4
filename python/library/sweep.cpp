/// Sweeps over parameters.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/text/specification.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/python/library/results.h"
#include "morsel/tools/study/sweep.h"

namespace morsel::python {
namespace {

/// What was found with one combination, column by column.
py::dict results(const tools::SweepRow& row) {
  py::dict result;
  result["minima"] = row.critical_points.minima;
  result["saddles"] = row.critical_points.saddles;
  result["saddle_multiplicity"] = row.critical_points.saddle_multiplicity;
  result["maxima"] = row.critical_points.maxima;
  result["total"] = row.critical_points.total();
  result["iterations_run"] = row.iterations_run ? py::cast(*row.iterations_run) : py::none();
  add_pairs(result, row.persistence);
  result["largest_persistence"] = row.persistence.largest ? py::cast(*row.persistence.largest) : py::none();
  result["min"] = row.min;
  result["max"] = row.max;
  result["seconds"] = row.seconds.sum();
  return result;
}

/// Throws InvalidArgument where a key that varies, a user's own, has the name of another column.
void check_columns(const tools::SweepPlan& plan) {
  const py::dict others = results({});
  for (const tools::Variation& one : plan.variations)
    if (others.contains(text(one.key)) || one.key == "field" || one.key == "method")
      throw core::InvalidArgument("the key " + one.key +
                                  " has the name of a column of the results; write it " +
                                  "with its method (NAME." + one.key + ") or field (field." + one.key + ")");
}

/// `values` is a field, or None where the request names a Morse function.
SweepHandle sweep(const MeshHandle& mesh, const FieldHandle& values, const std::string& field,
                  const std::string& method, const std::vector<std::string>& vary,
                  const tools::Registry& registry, const py::object& report) {
  tools::SweepRequest request{field, method, vary};
  FieldHandle given;
  if (values) {
    StudyField of = compute(py::none(), [&](const core::Progress&) { return study_field(values); });
    request.field = std::move(of.text);
    given = std::move(of.values);
  }
  tools::SweepPlan plan = tools::prepare(request, registry);
  check_columns(plan);
  return compute(report, [&](const core::Progress& progress) {
    auto data =
        std::make_shared<SweepData>(SweepData{{mesh, given}, std::move(request), std::move(plan), {}});
    data->rows = tools::run_sweep(data->input.loaded(), data->plan, {}, progress);
    return data;
  });
}

py::dict row_dict(const SweepHandle& sweep, std::size_t i) {
  if (i >= sweep->rows.size()) throw py::index_error("there is no such row");
  const tools::Combination& combination = sweep->plan.combinations[i];
  py::dict row;
  for (std::size_t k = 0; k < combination.choices.size(); ++k) {
    const tools::Variation& variation = sweep->plan.variations[k];
    row[text(variation.key)] = text(variation.values[combination.choices[k]]);
  }
  row["field"] = text(core::to_string(combination.field));
  row["method"] = text(core::to_string(combination.steps));
  row.attr("update")(results(sweep->rows[i]));
  return row;
}

}  // namespace

void add_sweep(py::module_& m) {
  py::class_<SweepData, SweepHandle>(m, "Sweep")
      .def("__len__", [](const SweepData& sweep) { return sweep.rows.size(); })
      .def("row", &row_dict)
      .def_property_readonly("values", [](const SweepData& s) { return s.input.values; })
      .def_property_readonly("mesh", [](const SweepData& s) { return s.input.mesh; })
      .def("warnings",
           [](const SweepHandle& sweep, std::size_t i) { return texts(sweep->rows.at(i).field.warnings); })
      .def_property_readonly("keys",
                             [](const SweepData& sweep) {
                               py::list keys;
                               for (const tools::Variation& one : sweep.plan.variations)
                                 keys.append(text(one.key));
                               return keys;
                             })
      .def_property_readonly("field_text", [](const SweepData& s) { return text(s.request.field); })
      .def_property_readonly("method_text", [](const SweepData& s) { return text(s.request.method); });
  m.def("sweep", &sweep);
}

}  // namespace morsel::python
