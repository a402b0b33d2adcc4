#include "morsel/python/binding/data.h"

#include <algorithm>

#include "morsel/core/error.h"
#include "morsel/core/text/specification.h"

namespace morsel::python {

FieldHandle given_field(const MeshHandle& mesh, core::ScalarField field, const std::string& name,
                        bool is_request) {
  const auto outcome = std::make_shared<const tools::FieldOutcome>(
      tools::FieldOutcome{"vertex-scalar", std::move(field), {{"property", name}}});
  FieldStory story;
  story.name = name;
  story.is_request = is_request;
  story.input = outcome;
  return std::make_shared<FieldData>(FieldData{mesh, {outcome, &outcome->field}, std::move(story)});
}

std::string function_text(const FieldStory& story) {
  return story.function.empty() ? "vertex-scalar:property=" + core::escape(story.name) : story.function;
}

std::string method_text(const FieldStory& story) {
  return story.method.empty() ? "conventional" : story.method;
}

core::LoadedMesh in_own_numbers(const core::LoadedMesh& loaded) {
  const core::Index count = loaded.mesh.vertex_count();
  core::LoadedMesh result{loaded.mesh, {{count, {}, {}}, loaded.source.properties, {}}};
  if (loaded.source.numbering.to_input.empty()) return result;
  for (std::size_t i = 0; i < result.source.properties.size(); ++i) {
    std::vector<double> values(count);
    for (core::Index v = 0; v < count; ++v)
      values[v] = loaded.source.properties[i].values[loaded.source.numbering.input_vertex(v)];
    result.source.properties[i].values = std::move(values);
  }
  return result;
}

core::LoadedMesh mesh_with_values(const FieldData& field) {
  if (!field.story.function.empty()) return field.mesh->loaded;
  core::LoadedMesh loaded = in_own_numbers(field.mesh->loaded);
  std::vector<core::VertexProperty>& properties = loaded.source.properties;
  std::erase_if(properties, [&](const auto& other) { return other.name == field.story.name; });
  const std::span<const double> values = field.story.input->field.values();
  properties.push_back({field.story.name, {values.begin(), values.end()}});
  return loaded;
}

tools::MethodChain steps_after(const FieldStory& story, const std::string& chain,
                               const tools::Registry& registry) {
  tools::MethodChain all = registry.make_method(story.method.empty() ? chain : story.method + "+" + chain);
  all.steps.erase(all.steps.begin(), all.steps.begin() + static_cast<std::ptrdiff_t>(story.steps.size()));
  return all;
}

FieldHandle without_methods(const FieldHandle& field) {
  const core::ScalarField& made = *field->field;
  if (field->story.method.empty() && field->story.is_request) return field;
  core::ScalarField by_value(made.mesh(), {made.values().begin(), made.values().end()});
  if (!std::ranges::equal(by_value.ranks(), made.ranks()))
    throw core::InvalidArgument(
        "this field has an order of its own, which its values do not give: name its methods in the study "
        "instead");
  return given_field(field->mesh, std::move(by_value), "values", true);
}

StudyInput study_input(const FieldHandle& field) {
  return {field->mesh, field->story.function.empty() ? field : nullptr};
}

StudyField study_field(const FieldHandle& field) {
  const FieldHandle plain = without_methods(field);
  return {function_text(plain->story), study_input(plain).values};
}

tools::MadeField made_field(const FieldData& field) {
  const FieldStory& story = field.story;
  std::vector<tools::StepOutcome> steps = story.steps;
  if (steps.empty()) steps.push_back({method_text(story), {}, {}, {}});  // of a request without a method
  return {*story.input, {*field.field, std::move(steps), story.reached}, story.method_seconds};
}

Documented documented(const FieldData& field, const tools::Registry& registry) {
  const FieldStory& story = field.story;
  if (!story.is_request)
    throw core::InvalidArgument(
        "this field was made by steps that no one command line makes (an order of one's own, its negative, "
        "or a method after a target), which a document cannot hold");
  tools::FieldRequest request{function_text(story), method_text(story), story.target};
  tools::FieldPlan plan = tools::prepare(request, registry);
  return {std::move(request), std::move(plan), made_field(field)};
}

}  // namespace morsel::python
