// study MESH: a user's Morse function and method, compared with those that ship. Prints their
// critical points.

#include <cstdio>
#include <memory>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/salient.h"
#include "morsel/tools/study/comparison.h"

using namespace morsel;

class Bend : public core::MorseFunction {
 public:
  core::FunctionResult evaluate(const core::TriangleMesh& mesh, const core::FunctionContext&) const override {
    return {morse::mean_curvature(mesh), {}};
  }
};

class TenTimes : public core::Method {
 public:
  core::MethodResult apply(const core::ScalarField& input, const core::MethodContext&) const override {
    return {morse::salient(input, {.iterations = 10}).field, {}, {}};
  }
};

class Counts : public tools::ComparisonSink {
 public:
  void field(const tools::FieldOutcome& outcome) override { std::printf("%s\n", outcome.name.c_str()); }
  void method(const tools::MethodOutcome& outcome) override {
    std::printf("%s: %zu\n", outcome.name.c_str(), outcome.measurement.critical_points.total());
  }
};

int main(int, char** arguments) {
  tools::Registry registry = tools::Registry::standard();
  registry.add(tools::FunctionEntry{"bend", "mean curvature",
                                    [](core::ParameterReader&) { return std::make_unique<Bend>(); }});
  registry.add(tools::MethodEntry{"ten-times", "salient smoothing",
                                  [](core::ParameterReader&) { return std::make_unique<TenTimes>(); }});
  tools::ComparisonRequest request;
  request.field = "bend";
  request.methods = {"conventional", "salient", "ten-times"};
  Counts counts;
  tools::run_comparison(core::read_mesh(arguments[1]), tools::prepare(request, registry), {&counts});
}
