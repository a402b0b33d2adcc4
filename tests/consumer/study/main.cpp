// study MESH FACTOR.txt REPORT.json: a user's Morse function, which reads a file, and a user's method,
// compared with those that ship. Prints their critical points and writes the report.

#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/text/specification.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/salient.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/study/comparison.h"

using namespace morsel;

class Bend : public core::MorseFunction {
 public:
  explicit Bend(std::string file) : file_(std::move(file)) {}
  core::FunctionResult evaluate(const core::TriangleMesh& mesh, const core::FunctionContext&) const override {
    double factor = 0;
    std::ifstream(file_) >> factor;
    const core::ScalarField curvature = morse::mean_curvature(mesh);
    std::vector<double> values(curvature.values().begin(), curvature.values().end());
    for (double& value : values) value *= factor;
    return {core::ScalarField(mesh, std::move(values)), {{"factor", file_}}};
  }

 private:
  std::string file_;
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
  registry.add(tools::FunctionEntry{"bend", "mean curvature times the number in a file",
                                    [](core::ParameterReader& reader) {
                                      return std::make_unique<Bend>(
                                          reader.file("factor", nullptr, "the file with the number"));
                                    },
                                    "1/length"});
  registry.add(tools::MethodEntry{"ten-times", "salient smoothing",
                                  [](core::ParameterReader&) { return std::make_unique<TenTimes>(); }});
  tools::ComparisonRequest request;
  request.field = "bend:factor=" + core::escape(arguments[2]);
  request.methods = {"conventional", "salient", "ten-times"};
  const tools::HashedMesh mesh = tools::read_hashed_mesh(arguments[1]);
  std::ofstream out(arguments[3]);
  tools::JsonStream json(out);
  tools::ReportWriter report(json, mesh.loaded, {arguments[1], mesh.sha256}, request);
  Counts counts;
  tools::run_comparison(mesh.loaded, tools::prepare(request, registry), {&counts, &report});
  report.finish();
}
