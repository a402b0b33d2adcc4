// own_method MESH: a Morse function and a method of one's own, by name, in a comparison with those that ship.

#include <cstdio>
#include <memory>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/study/comparison.h"

using namespace morsel;

class Radius : public core::MorseFunction {
 public:
  core::FunctionResult evaluate(const core::TriangleMesh& mesh, const core::FunctionContext&) const override {
    const core::Point middle = (mesh.bounding_box().min + mesh.bounding_box().max) / 2;
    std::vector<double> values;
    for (const core::Point& point : mesh.positions()) values.push_back((point - middle).norm());
    return {core::ScalarField(mesh, std::move(values)), {}};
  }
};

/// Values rounded down to steps: plateaus, whose order is that of their vertices' numbers.
class Steps : public core::Method {
 public:
  explicit Steps(std::int64_t count) : count_(count) {}
  core::MethodResult apply(const core::ScalarField& input, const core::MethodContext&) const override {
    std::vector<double> values(input.values().begin(), input.values().end());
    const double step = input.extent() / static_cast<double>(count_);
    for (double& value : values) value = input.min() + step * static_cast<int>((value - input.min()) / step);
    return {core::ScalarField(input.mesh(), std::move(values)), {{"count", count_}}, {}};
  }

 private:
  std::int64_t count_;
};

class Table : public tools::ComparisonSink {
  void field(const tools::FieldOutcome& outcome) override { std::printf("%s\n", outcome.name.c_str()); }
  void method(const tools::MethodOutcome& outcome) override {
    std::printf("%s: %zu points\n", outcome.specification.c_str(),
                outcome.measurement.critical_points.total());
  }
};

int main(int, char** arguments) {
  tools::Registry registry = tools::Registry::standard();
  registry.add(tools::FunctionEntry{"radius", "distance from the middle of the bounding box",
                                    [](core::ParameterReader&) { return std::make_unique<Radius>(); }});
  registry.add(tools::MethodEntry{"steps", "values rounded to steps", [](core::ParameterReader& reader) {
                                    return std::make_unique<Steps>(
                                        reader.count("count", 100, 1, 1000000, "how many"));
                                  }});
  Table table;
  tools::run_comparison(
      core::read_mesh(arguments[1]),
      tools::prepare({.field = "radius", .methods = {"conventional", "steps:count=20+tps"}, .target = {}},
                     registry),
      {&table});
}
