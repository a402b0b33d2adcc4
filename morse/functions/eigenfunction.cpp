#include "morsel/morse/functions/eigenfunction.h"

#include <utility>

#include "morsel/morse/operators/eigenfunctions.h"

namespace morsel::morse {
namespace {

class EigenfunctionField final : public core::MorseFunction {
 public:
  explicit EigenfunctionField(std::int64_t index) : index_(index) {}

  core::FunctionResult evaluate(const core::TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    std::vector<Eigenfunction> all = eigenfunctions(mesh, static_cast<std::size_t>(index_), context.progress);
    Eigenfunction& last = all.back();
    core::Parameters parameters = {{"index", index_},
                                   {"eigenvalue", last.eigenvalue},
                                   {"residual", last.residual / last.eigenvalue},
                                   {"component", static_cast<std::int64_t>(last.component)}};
    return {core::ScalarField(mesh, std::move(last.phi)), std::move(parameters)};
  }

 private:
  std::int64_t index_;
};

}  // namespace

std::unique_ptr<core::MorseFunction> make_eigenfunction(core::ParameterReader& reader) {
  return std::make_unique<EigenfunctionField>(
      reader.count("index", 1, 1, kMostModes, "which one: 1 has the smallest eigenvalue above 0"));
}

}  // namespace morsel::morse
