#include "morsel/morse/smoothing/conventional.h"

namespace morsel::morse {
namespace {

class Conventional final : public core::Method {
 public:
  core::MethodResult apply(const core::ScalarField& input, const core::MethodContext&) const override {
    return {input, {}, {}};
  }
};

}  // namespace

std::unique_ptr<core::Method> make_conventional(core::ParameterReader&) {
  return std::make_unique<Conventional>();
}

}  // namespace morsel::morse
