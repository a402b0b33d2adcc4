#include "morsel/morse/functions/height.h"

#include <string>
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

/// Three numbers.
Point parse_direction(const std::vector<std::string>& numbers, const std::string& what) {
  std::vector<double> parts;
  for (const std::string& number : numbers)
    parts.push_back(core::parse_number(number, what + " (three numbers, as in 1/0/-2)"));
  if (parts.size() != 3)
    throw core::InvalidArgument(what + " must be three numbers, as in 1/0/-2, not " +
                                std::to_string(parts.size()));
  return {parts[0], parts[1], parts[2]};
}

/// As it is written: "a/b/c".
std::string joined(const std::vector<std::string>& numbers) {
  std::string text;
  for (const std::string& number : numbers) text += (text.empty() ? "" : "/") + number;
  return text;
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
  const std::vector<std::string> numbers =
      reader.list("direction", "", "any direction a/b/c instead of an axis; its length does not matter");
  if (!reader.given("direction")) {
    Point direction = Point::Zero();
    direction[axis[0] - 'x'] = 1;
    return std::make_unique<Height>(direction, core::Parameters{{"axis", axis}});
  }
  if (reader.given("axis"))
    throw core::InvalidArgument(reader.owner() + " takes axis or direction, not both");
  const Point direction = parse_direction(numbers, reader.owner() + ":direction");
  unit(direction);  // refuses zero here, before any mesh is read
  return std::make_unique<Height>(direction, core::Parameters{{"direction", joined(numbers)}});
}

}  // namespace morsel::morse
