#include "morsel/tools/study/quadrangulation.h"

#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {
namespace {

struct Simplified {
  double threshold = 0;
  core::Index cancelled = 0;
  mscomplex::MorseSmaleComplex complex;
};

Simplified simplify(const core::ScalarField& field, const QuadPlan& plan, const core::Progress& progress) {
  if (!plan.persistence) return {0, 0, mscomplex::MorseSmaleComplex(field, progress)};
  const double threshold = plan.persistence->on(field);
  const mscomplex::PersistenceHierarchy hierarchy(field, progress);
  const core::Index level = hierarchy.level_above(threshold);
  return {threshold, level, mscomplex::MorseSmaleComplex(field, hierarchy.gradient(level), progress)};
}

std::string plural(std::size_t count, const char* one, const char* many) {
  return core::grouped(count) + " " + (count == 1 ? one : many);
}

}  // namespace

QuadPlan prepare(const QuadRequest& request) {
  QuadPlan plan;
  if (!request.persistence.empty())
    plan.persistence = persistence::parse_threshold(request.persistence, "the persistence");
  if (request.resolution < 2)
    throw core::InvalidArgument("the resolution must be 2 or more, not " +
                                std::to_string(request.resolution));
  if (request.relaxation < 0)
    throw core::InvalidArgument("the relaxation must be 0 or more, not " +
                                std::to_string(request.relaxation));
  plan.resolution = request.resolution;
  plan.relaxation = request.relaxation;
  return plan;
}

Quadrangulation quadrangulate(const core::ScalarField& field, const QuadPlan& plan,
                              const core::Progress& progress) {
  if (!field.mesh().is_closed() && (plan.resolution % 2 != 0 || plan.resolution < 4))
    throw core::InvalidArgument(
        "the resolution must be 4 or more and even on a surface with boundary loops, where patches have five "
        "sides and are cut into five at their middles");
  const Stopwatch layout_watch;
  Simplified simplified = simplify(field, plan, progress);
  mscomplex::RepairedComplex repaired =
      mscomplex::repair_dangling(field, std::move(simplified.complex), progress);
  mscomplex::QuadLayout layout =
      mscomplex::embed_layout(repaired.complex, {.relaxation = plan.relaxation}, progress);
  const double layout_seconds = layout_watch.seconds();
  const Stopwatch sampling_watch;
  mscomplex::QuadMesh mesh = mscomplex::sample(layout, plan.resolution, progress);
  mscomplex::validate(mesh, field.mesh().euler_characteristic(), field.mesh().boundary_loop_count());
  const double sampling_seconds = sampling_watch.seconds();
  const Stopwatch measuring_watch;
  mscomplex::QuadQuality quality = mscomplex::measure(mesh, field.mesh(), progress);
  return {simplified.threshold, simplified.cancelled, std::move(repaired),
          std::move(layout),    std::move(mesh),      std::move(quality),
          layout_seconds,       sampling_seconds,     measuring_watch.seconds()};
}

core::Index boundary_patches(const mscomplex::MorseSmaleComplex& complex) {
  core::Index count = 0;
  for (core::Index q = 0; q < complex.quad_count(); ++q)
    if (complex.kind(complex.quad(q).nodes[2]) == mscomplex::NodeKind::cap) ++count;
  return count;
}

std::string described(const Quadrangulation& result, double diagonal) {
  const mscomplex::MorseSmaleComplex& complex = result.repaired.complex;
  const mscomplex::QuadQuality& q = result.quality;
  std::string text;
  if (result.cancelled > 0)
    text += "cancelled: " + plural(result.cancelled, "pair", "pairs") + " below the persistence threshold\n";
  if (!result.repaired.repairs.empty())
    text += "repaired: " + plural(result.repaired.repairs.size(), "dangling arc", "dangling arcs") +
            ", each an extremum with a single arc, cancelled with its saddle\n";
  text += "layout: " + plural(complex.quad_count(), "patch", "patches") + " between " +
          plural(complex.minimum_count(), "minimum", "minima") + ", " +
          plural(complex.saddle_count(), "saddle", "saddles") + " and " +
          plural(complex.maximum_count(), "maximum", "maxima");
  if (complex.cap_count() > 0)
    text += "; " + plural(boundary_patches(complex), "patch", "patches") + " at " +
            plural(complex.cap_count(), "boundary loop", "boundary loops") + ", of five sides";
  text += "\n";
  if (result.layout.missed > 0)
    text +=
        "        " + plural(result.layout.missed, "arc follows", "arcs follow") +
        " the path through the fewest triangles, as double precision does not suffice for a straight line\n";
  if (result.layout.left > 0)
    text += "        relaxations left a node in place " + plural(result.layout.left, "time", "times") +
            ", as its arcs would need too many triangles\n";
  text += "quads: " + core::grouped(result.mesh.quads.size()) + " on " +
          core::grouped(result.mesh.positions.size()) + " vertices, of which " +
          core::grouped(q.extraordinary) + " extraordinary; by valence";
  for (std::size_t k = 0; k < q.valence.size(); ++k)
    if (q.valence[k] > 0) text += " " + std::to_string(k) + ": " + core::grouped(q.valence[k]) + ",";
  text.pop_back();
  text += "\nangles: off 90° by " + core::to_decimals(q.angle_mean, 1) + "° in the mean, " +
          core::to_decimals(q.angle_max, 1) + "° at most; scaled Jacobian " +
          core::to_decimals(q.scaled_jacobian_mean, 3) + " in the mean, " +
          core::to_decimals(q.scaled_jacobian_min, 3) + " at least; " + plural(q.concave, "quad", "quads") +
          " not convex";
  text += "\nareas: standard deviation " + core::to_decimals(100 * q.area_deviation, 0) +
          " % of the mean, from " + core::to_decimals(q.area_min, 3) + " to " +
          core::to_decimals(q.area_max, 2) + " times it";
  const double percent = diagonal > 0 ? 100 / diagonal : 0;
  text += "\ndistance: " + core::to_decimals(percent * q.distance_max, 2) +
          " % of the diagonal at most to the input, " +
          core::to_decimals(percent * q.distance_from_input, 2) + " % from it\n";
  return text;
}

}  // namespace morsel::tools
