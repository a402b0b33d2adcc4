#pragma once
/// Rays against triangles, spheres and capsules (Embree).

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "morsel/core/mesh/mesh.h"

namespace morsel::tools::render {

using Vec3 = Eigen::Vector3f;

/// The first intersection of a ray.
struct Hit {
  enum class Kind : std::uint8_t { triangle, sphere, capsule };
  Kind kind = Kind::triangle;
  std::uint32_t item = 0;  ///< its number in the order in which it was given
  float distance = 0;      ///< in lengths of the ray's direction
  float u = 0;             ///< of triangles: weights of the second and the third corner
  float v = 0;
  Vec3 normal;  ///< unit, of the item, on either side
};

struct Ball {
  Vec3 center;
  float radius;
};
/// All points within a distance of a segment.
struct Capsule {
  Vec3 a;
  Vec3 b;
  float radius;
};

/// A set of surfaces for ray intersections, of about unit size. Immutable; safe from any number of threads.
/// Results do not depend on the number of threads. Throws std::bad_alloc if there is not enough memory.
class Rays {
 public:
  explicit Rays(const core::TriangleMesh& mesh, std::span<const Ball> balls = {},
                std::span<const Capsule> capsules = {});
  ~Rays();
  Rays(Rays&&) noexcept;
  Rays& operator=(Rays&&) noexcept;

  /// The first intersection between `near` and `far` along the ray; false if there is none. Balls and
  /// capsules are not hit from inside.
  bool first(const Vec3& origin, const Vec3& direction, float near, float far, Hit& hit) const;
  /// Whether there is any intersection.
  bool any(const Vec3& origin, const Vec3& direction, float near, float far) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

inline constexpr float kFar = std::numeric_limits<float>::infinity();

}  // namespace morsel::tools::render
