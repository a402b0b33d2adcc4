// own_method MESH REPORT.json: a Morse function and a method of one's own, by name, in a comparison with
// those that ship, as a table and as a report.

#include <fstream>
#include <iostream>
#include <memory>
#include <vector>

#include "morsel/tools/report/comparison_table.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/report_writer.h"

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

int main(int, char** arguments) {
  tools::Registry registry = tools::Registry::standard();
  registry.add(tools::FunctionEntry{"radius", "distance from the middle of the bounding box",
                                    [](core::ParameterReader&) { return std::make_unique<Radius>(); },
                                    "length"});
  registry.add(tools::MethodEntry{"steps", "values rounded to steps", [](core::ParameterReader& reader) {
                                    return std::make_unique<Steps>(
                                        reader.count("count", 100, 1, 1000000, "how many"));
                                  }});
  tools::ComparisonRequest request;
  request.field = "radius";
  request.methods = {"conventional", "steps:count=20+tps"};
  const tools::HashedMesh mesh = tools::read_hashed_mesh(arguments[1]);
  std::ofstream out(arguments[2]);
  tools::JsonStream json(out);
  tools::ReportWriter report(json, mesh.loaded, {arguments[1], mesh.sha256}, request);
  tools::ComparisonTable table;
  tools::run_comparison(mesh.loaded, tools::prepare(request, registry), {&report, &table});
  report.finish();
  std::cout << table.text();
}
