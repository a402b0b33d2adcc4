#include "morsel/morse/functions/height.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {
namespace {

using core::Point;

Point unit(const Point& direction) {
  const double largest = direction.cwiseAbs().maxCoeff();
  if (!direction.allFinite() || !(largest > 0))
    throw core::InvalidArgument("a direction must be finite and not zero, unlike " +
                                core::shortest(direction.x()) + "/" + core::shortest(direction.y()) + "/" +
                                core::shortest(direction.z()));
  const Point scaled = direction / largest;  // its square neither overflows nor vanishes
  return scaled / scaled.norm();
}

/// "a/b/c" as three numbers.
Point parse_direction(std::string_view text, const std::string& what) {
  std::vector<double> parts;
  for (std::string_view rest = text;;) {
    const std::size_t slash = rest.find('/');
    parts.push_back(core::parse_number(rest.substr(0, slash), what + " (three numbers, as in 1/0/-2)"));
    if (slash == std::string_view::npos) break;
    rest.remove_prefix(slash + 1);
  }
  if (parts.size() != 3)
    throw core::InvalidArgument(what + " must be three numbers, as in 1/0/-2, not " +
                                std::to_string(parts.size()));
  return {parts[0], parts[1], parts[2]};
}

class Height final : public core::MorseFunction {
 public:
  Height(const Point& direction, core::Parameters parameters)
      : options_{direction}, parameters_(std::move(parameters)) {}

  core::FunctionResult evaluate(const core::TriangleMesh& mesh, const core::FunctionContext&) const override {
    return {height(mesh, options_), parameters_};
  }

 private:
  HeightOptions options_;
  core::Parameters parameters_;
};

}  // namespace

core::ScalarField height(const core::TriangleMesh& mesh, const HeightOptions& options) {
  const Point u = unit(options.direction);
  std::vector<double> values(mesh.vertex_count());
  core::parallel_for_each(values.size(), [&](std::size_t v) {
    const Point& p = mesh.position(static_cast<core::Index>(v));
    values[v] = p.x() * u.x() + p.y() * u.y() + p.z() * u.z();
  });
  return {mesh, std::move(values)};
}

std::unique_ptr<core::MorseFunction> make_height(core::ParameterReader& reader) {
  const std::string axis = reader.choice("axis", "z", {"x", "y", "z"}, "the coordinate to take");
  const std::string text =
      reader.text("direction", "", "any direction a/b/c instead of an axis; its length does not matter");
  if (!reader.given("direction")) {
    Point direction = Point::Zero();
    direction[axis[0] - 'x'] = 1;
    return std::make_unique<Height>(direction, core::Parameters{{"axis", axis}});
  }
  if (reader.given("axis"))
    throw core::InvalidArgument(reader.owner() + " takes axis or direction, not both");
  const Point direction = parse_direction(text, reader.owner() + ":direction");
  unit(direction);  // refuses zero here, before any mesh is read
  return std::make_unique<Height>(direction, core::Parameters{{"direction", text}});
}

}  // namespace morsel::morse
