#include "morsel/python/binding/own.h"

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/rethrow.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"

namespace morsel::python {
namespace {

/// The path of a file that the function reads.
struct Path {
  std::string text;
};

using Default = std::variant<bool, std::int64_t, double, core::Length, Path, std::string>;

struct OwnParameter {
  std::string key;
  Default default_value;
  std::string description;
};

OwnParameter read_parameter(const py::tuple& given) {
  const auto kind = given[1].cast<std::string>();
  const py::object value = given[2];
  OwnParameter parameter{given[0].cast<std::string>(), {}, given[3].cast<std::string>()};
  if (kind == "flag")
    parameter.default_value = value.cast<bool>();
  else if (kind == "count")
    parameter.default_value = value.cast<std::int64_t>();
  else if (kind == "number")
    parameter.default_value = value.cast<double>();
  else if (kind == "length")
    parameter.default_value = core::parse_length(value.cast<std::string>(), parameter.key);
  else if (kind == "file")
    parameter.default_value = Path{value.cast<std::string>()};
  else
    parameter.default_value = value.cast<std::string>();
  return parameter;
}

std::vector<OwnParameter> read_parameters(const py::list& given) {
  std::vector<OwnParameter> parameters;
  for (const py::handle& one : given) parameters.push_back(read_parameter(one.cast<py::tuple>()));
  return parameters;
}

/// The values of the parameters, by key.
using Values = std::vector<std::pair<std::string, Default>>;

Values read_values(core::ParameterReader& reader, const std::vector<OwnParameter>& parameters) {
  Values values;
  for (const OwnParameter& p : parameters) {
    const auto read = [&](const auto& fallback) -> Default {
      using T = std::decay_t<decltype(fallback)>;
      if constexpr (std::is_same_v<T, bool>)
        return reader.flag(p.key, fallback, p.description);
      else if constexpr (std::is_same_v<T, std::int64_t>)
        return reader.count(p.key, fallback, INT64_MIN, INT64_MAX, p.description);
      else if constexpr (std::is_same_v<T, double>)
        return reader.number(p.key, fallback, {}, p.description);
      else if constexpr (std::is_same_v<T, core::Length>)
        return reader.length(p.key, fallback, {}, p.description);
      else if constexpr (std::is_same_v<T, Path>)
        return Path{reader.file(p.key, fallback.text.c_str(), p.description)};
      else
        return reader.text(p.key, fallback.c_str(), p.description);
    };
    values.emplace_back(p.key, std::visit(read, p.default_value));
  }
  return values;
}

core::Parameters resolved(const Values& values, const core::TriangleMesh& mesh) {
  core::Parameters result;
  for (const auto& [key, value] : values)
    result.emplace_back(key, std::visit(
                                 [&](const auto& held) -> core::ParameterValue {
                                   if constexpr (std::is_same_v<std::decay_t<decltype(held)>, core::Length>)
                                     return held.on(mesh);
                                   else if constexpr (std::is_same_v<std::decay_t<decltype(held)>, Path>)
                                     return held.text;
                                   else
                                     return held;
                                 },
                                 value));
  return result;
}

/// Python's function behind a name.
struct Own {
  std::string name;
  std::shared_ptr<py::object> call;
};

/// What Python returned: values, or a whole field.
struct Returned {
  std::vector<double> values;
  std::shared_ptr<const core::ScalarField> field;
};

Returned checked(const Own& own, const py::object& result, const core::TriangleMesh& mesh) {
  if (py::isinstance<FieldData>(result)) {
    const auto field = result.cast<std::shared_ptr<FieldData>>();
    if (!field->field->mesh().is_same(mesh))
      throw core::InvalidArgument(own.name + " returned a field on another mesh than its input's");
    return {{}, field->field};
  }
  if (!py::isinstance<py::array>(result))
    throw core::InvalidArgument(own.name + " must return an array of a value per vertex or a Field");
  const std::string what = "the values that " + own.name + " returns";
  std::vector<double> values = values_from(result.cast<py::array>(), what.c_str());
  if (values.size() != mesh.vertex_count())
    throw core::InvalidArgument(own.name + " returned " + std::to_string(values.size()) +
                                " values, but the mesh has " + std::to_string(mesh.vertex_count()) +
                                " vertices");
  return {std::move(values), nullptr};
}

/// Calls it with the object that make() makes of its input.
template <class Make>
core::ScalarField call_own(const Own& own, const core::Parameters& values, const core::TriangleMesh& mesh,
                           const core::Progress& progress, const Make& make) {
  Returned returned;
  call_python(progress, [&] { returned = checked(own, (*own.call)(make(), parameters(values)), mesh); });
  if (returned.field) return *returned.field;
  try {
    return {mesh, std::move(returned.values)};
  } catch (const core::Error& error) {
    core::rethrow_at(error, own.name);
  }
}

MeshHandle handle_of(const core::TriangleMesh& mesh, const core::MeshSource* source) {
  return std::make_shared<MeshData>(
      MeshData{{mesh, source != nullptr ? *source : core::MeshSource()}, {}, false});
}

class OwnFunction final : public core::MorseFunction {
 public:
  OwnFunction(Own own, Values values) : own_(std::move(own)), values_(std::move(values)) {}
  core::FunctionResult evaluate(const core::TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    core::Parameters parameters = resolved(values_, mesh);
    core::ScalarField field = call_own(own_, parameters, mesh, context.progress,
                                       [&] { return py::cast(handle_of(mesh, context.source)); });
    return {std::move(field), std::move(parameters)};
  }

 private:
  Own own_;
  Values values_;
};

class OwnMethod final : public core::Method {
 public:
  OwnMethod(Own own, Values values) : own_(std::move(own)), values_(std::move(values)) {}
  core::MethodResult apply(const core::ScalarField& input,
                           const core::MethodContext& context) const override {
    core::Parameters parameters = resolved(values_, input.mesh());
    core::ScalarField field = call_own(own_, parameters, input.mesh(), context.progress, [&] {
      return py::cast(
          given_field(handle_of(input.mesh(), nullptr), core::ScalarField(input), "values", false));
    });
    return {std::move(field), std::move(parameters), {}};
  }

 private:
  Own own_;
  Values values_;
};

template <class Made>
auto maker(const std::string& name, const py::list& parameters, py::object call) {
  return [own = Own{name, shared(std::move(call))},
          declared = read_parameters(parameters)](core::ParameterReader& reader) {
    return std::make_unique<Made>(own, read_values(reader, declared));
  };
}

}  // namespace

void add_own_function(tools::Registry& registry, const std::string& name, const std::string& summary,
                      const py::list& parameters, py::object call) {
  registry.add(tools::FunctionEntry{name, summary, maker<OwnFunction>(name, parameters, std::move(call))});
}

void add_own_method(tools::Registry& registry, const std::string& name, const std::string& summary,
                    const py::list& parameters, py::object call) {
  registry.add(tools::MethodEntry{name, summary, maker<OwnMethod>(name, parameters, std::move(call))});
}

}  // namespace morsel::python
