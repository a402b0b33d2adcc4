/// Hierarchies: by persistence, every level of one complex; by iteration, the fields that a method passes.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/field/method.h"
#include "morsel/core/text/specification.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/python/library/results.h"
#include "morsel/tools/study/hierarchy.h"
#include "morsel/tools/study/iteration_levels.h"
#include "morsel/tools/study/level_builder.h"
#include "morsel/tools/study/persistence_levels.h"

namespace morsel::python {
namespace {

using core::Index;
using mscomplex::Cancellation;
using mscomplex::MorseSmaleComplex;
using mscomplex::PersistenceHierarchy;
using tools::Level;

struct HierarchyData {
  FieldHandle field;
  std::shared_ptr<const PersistenceHierarchy> hierarchy;
};
using HierarchyHandle = std::shared_ptr<HierarchyData>;

HierarchyHandle hierarchy_of(const FieldHandle& field, const py::object& report) {
  return compute(report, [&](const core::Progress& progress) {
    return std::make_shared<HierarchyData>(
        HierarchyData{field, std::make_shared<const PersistenceHierarchy>(*field->field, progress)});
  });
}

Index checked_level(const HierarchyHandle& h, Index level) {
  if (level > h->hierarchy->levels())
    throw py::index_error("the hierarchy has the levels 0 to " + std::to_string(h->hierarchy->levels()) +
                          "; there is no level " + std::to_string(level));
  return level;
}

ComplexHandle complex_at(const HierarchyHandle& h, Index level, const py::object& report) {
  checked_level(h, level);
  return compute(report, [&](const core::Progress& progress) {
    return complex_handle(
        std::make_shared<const MorseSmaleComplex>(*h->field->field, h->hierarchy->gradient(level), progress));
  });
}

/// (minima, saddles with their multiplicities, maxima)
py::tuple counts_at(const HierarchyHandle& h, Index level) {
  checked_level(h, level);
  return py::make_tuple(h->hierarchy->minimum_count(level), h->hierarchy->saddle_count(level),
                        h->hierarchy->maximum_count(level));
}

LevelsHandle built(const FieldHandle& field, tools::HierarchyRequest request,
                   std::vector<tools::LevelSeed> seeds, const core::Progress& progress) {
  auto result = std::make_shared<LevelsData>(LevelsData{field, std::move(request), {}, {}});
  tools::build_levels(
      std::move(seeds),
      [&](Level level) { result->levels.push_back(std::make_shared<const Level>(std::move(level))); },
      progress);
  return result;
}

/// The field's own function and methods, as a request.
tools::HierarchyRequest request_of(const FieldHandle& field, tools::HierarchyKind kind,
                                   const std::string& method) {
  tools::HierarchyRequest request;
  request.field = {function_text(field->story), method, field->story.target};
  request.kind = kind;
  return request;
}

/// Levels by persistence, at thresholds or at numbers of critical cells.
LevelsHandle persistence_levels(const HierarchyHandle& h, const std::string& levels,
                                const std::string& counts, const tools::Registry& registry,
                                const py::object& report) {
  tools::HierarchyRequest request =
      request_of(h->field, tools::HierarchyKind::persistence, method_text(h->field->story));
  request.levels = levels;
  request.counts = counts;
  const tools::HierarchyPlan plan = tools::prepare(request, registry);
  return compute(report, [&](const core::Progress& progress) {
    const tools::FieldHierarchy from{h->field->field, h->hierarchy};
    return built(h->field, request,
                 plan.counts.empty() ? tools::levels_by_threshold(from, plan.thresholds)
                                     : tools::levels_by_count(from, plan.counts),
                 progress);
  });
}

/// A chain of methods after those that a field has.
std::string after(const FieldStory& story, const std::string& chain) {
  return story.method.empty() ? chain : story.method + "+" + chain;
}

/// The chain's text with another number of iterations of its last step, which gives one.
std::string with_number(const tools::MethodChain& chain, int iterations) {
  std::vector<core::Specification> steps = core::parse_chain(chain.specification, "the method");
  for (auto& [key, value] : steps.back().given)
    if (key == core::kIterationsKey) value = std::to_string(iterations);
  return core::to_string(steps);
}

/// What a run of more iterations says of its last step, as a run of fewer does.
tools::StepOutcome ended_at(tools::StepOutcome step, int iterations) {
  for (core::Parameters* values : {&step.parameters, &step.details})
    for (auto& [key, value] : *values)
      if (key == core::kIterationsKey || key == "iterations_run") value = std::int64_t{iterations};
  step.iterations.resize(std::min(step.iterations.size(), static_cast<std::size_t>(iterations) + 1));
  step.end = core::IterationEnd{iterations, std::string(core::kIterationsKey)};
  return step;
}

/// The field of a level by iteration, made by the steps of `chain` from `input`.
FieldHandle field_of(const Level& level, const FieldHandle& input, const tools::MethodChain& chain,
                     std::vector<tools::StepOutcome> steps) {
  const int number = *level.name.iteration;
  FieldStory story = input->story;
  story.method = after(story, with_number(chain, number));
  story.is_request = story.is_request && chain.steps.back().method->traits().iterates_are_results;
  steps.back() = ended_at(std::move(steps.back()), number);
  story.steps.insert(story.steps.end(), steps.begin(), steps.end());
  return std::make_shared<FieldData>(FieldData{input->mesh, level.field, std::move(story)});
}

/// Levels by iteration of the last method of a chain.
LevelsHandle iteration_levels(const FieldHandle& field, const std::string& method, const std::string& levels,
                              const tools::Registry& registry, const py::object& report) {
  const FieldStory& story = field->story;
  if (story.target)
    throw core::InvalidArgument("levels by iteration are not made of a field that was ended at a target");
  tools::HierarchyRequest request = request_of(field, tools::HierarchyKind::iteration, after(story, method));
  request.levels = levels;
  tools::HierarchyRequest own_steps = request;  // of the chain without the steps that the field has
  own_steps.field = {"height", method, {}};
  const tools::HierarchyPlan plan = tools::prepare(own_steps, registry);
  const tools::MethodChain chain = steps_after(story, plan.field.chain.specification, registry);
  const tools::NamedFunction function = function_for(chain, story, registry);
  return compute(report, [&](const core::Progress& progress) {
    tools::IterationLevels found = tools::iteration_levels(chain, mesh_with_values(*field), function,
                                                           *field->field, plan.iterations, progress);
    LevelsHandle made = built(field, request, std::move(found.seeds), progress);
    for (const std::shared_ptr<const Level>& level : made->levels)
      made->fields.push_back(field_of(*level, field, chain, found.outcome.steps));
    return made;
  });
}

/// (areas, parents, merges_into) of cells of one kind.
py::tuple links(const std::shared_ptr<const Level>& level, mscomplex::SegmentKind kind) {
  const tools::CellLinks& of = level->cell_links(kind);
  return py::make_tuple(view_of(std::span<const double>(of.areas), level),
                        view_of(std::span<const mscomplex::Overlap>(of.parents), level),
                        view_of(std::span<const mscomplex::Overlap>(of.merges_into), level));
}

std::shared_ptr<const Level> level_at(const LevelsHandle& levels, std::size_t place) {
  if (place >= levels->levels.size()) throw py::index_error("there is no such level");
  return levels->levels[place];
}

/// What the fields of a level are in Python.
py::dict level_dict(const LevelsHandle& levels, std::size_t place) {
  const std::shared_ptr<const Level> level = level_at(levels, place);
  py::dict result;
  result["name"] = text(level->name.asked);
  result["note"] = text(level->name.note);
  result["iteration"] = level->name.iteration ? py::cast(*level->name.iteration) : py::none();
  result["cancellations"] =
      level->name.cancelled ? py::cast(level->name.cancelled->cancellations) : py::none();
  result["largest_persistence"] =
      level->name.cancelled ? py::cast(level->name.cancelled->largest) : py::none();
  result["field"] = levels->fields.empty() ? levels->field : levels->fields[place];
  result["points"] = view_of(std::span<const morse::CriticalPoint>(level->points.points), level);
  result["persistence"] = view_of(std::span<const double>(level->persistence), level);
  result["parents"] = view_of(std::span<const Index>(level->parents), level);
  result["complex"] = complex_handle({level, &level->complex});
  result["segmentation"] = segmentation_dict({level, &level->segmentation});
  result["cell_count"] = level->quad_cells;
  for (const mscomplex::SegmentKind kind : mscomplex::kSegmentKinds)
    result[py::str("links_" + tools::key_of(kind))] = links(level, kind);
  result["timings"] = timings(level->timings);
  return result;
}

}  // namespace

void add_hierarchy(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Cancellation, arc, extremum, survivor, persistence);
  PYBIND11_NUMPY_DTYPE(mscomplex::Overlap, segment, area);
  py::class_<HierarchyData, HierarchyHandle>(m, "Hierarchy")
      .def_property_readonly("levels", [](const HierarchyData& h) { return h.hierarchy->levels(); })
      .def_property_readonly(
          "cancellations",
          [](const HierarchyData& h) { return view_of(h.hierarchy->cancellations(), h.hierarchy); })
      .def("level_above",
           [](const HierarchyData& h, double threshold) { return h.hierarchy->level_above(threshold); })
      .def("level_with",
           [](const HierarchyData& h, std::size_t count) { return h.hierarchy->level_with(count); })
      .def("counts", &counts_at)
      .def("complex_at", &complex_at)
      .def("linked", &persistence_levels);
  py::class_<LevelsData, LevelsHandle>(m, "Levels")
      .def("__len__", [](const LevelsData& levels) { return levels.levels.size(); })
      .def("level", &level_dict);
  m.def("hierarchy", &hierarchy_of);
  m.def("iteration_levels", &iteration_levels);
}

}  // namespace morsel::python
