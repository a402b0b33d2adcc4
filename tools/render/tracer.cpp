#include "morsel/tools/render/tracer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "morsel/core/error.h"
#include "morsel/core/parallel.h"

namespace morsel::tools::render {
namespace {

constexpr int kTile = 16;          // pixels
constexpr int kSkyRays = 4;        // a sample
constexpr int kLightRays = 2;      // a sample
constexpr float kSkyReach = 0.3f;  // beyond this nothing darkens
constexpr float kClear = 2e-4f;    // rays from a surface start that far above it

/// Well mixed bits (Wellons 2018).
std::uint32_t mixed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

/// Points of the unit square or line that fill it evenly, from a start of their own. In whole numbers, so that they are
/// the same everywhere.
class Sequence {
 public:
  explicit Sequence(std::uint32_t seed) : x_(mixed(seed)), y_(mixed(seed ^ 0x9e3779b9u)) {}
  struct Pair {
    float x, y;
  };
  Pair operator()(std::uint32_t i) const {
    return {unit(x_ + i * 3242174889u), unit(y_ + i * 2447445414u)};  // 2^32 / 1.3247…, and its square
  }
  float line(std::uint32_t i) const { return unit((x_ ^ y_) + i * 2654435769u); }  // 2^32 / golden ratio

 private:
  static float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
  std::uint32_t x_, y_;
};

/// Two vectors that make a right-handed frame of a unit vector (Duff et al. 2017).
struct Frame {
  explicit Frame(const Vec3& n) : normal(n) {
    const float sign = std::copysign(1.f, n[2]);
    const float a = -1 / (sign + n[2]);
    const float b = n[0] * n[1] * a;
    tangent = {1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
    bitangent = {b, sign + n[1] * n[1] * a, -n[1]};
  }
  Vec3 at(float x, float y, float z) const { return x * tangent + y * bitangent + z * normal; }
  Vec3 normal, tangent, bitangent;
};

/// Evenly on the disc (Shirley, Chiu 1997, in polar form).
Eigen::Vector2f on_disc(Sequence::Pair p) {
  const float r = std::sqrt(p.x);
  const float angle = 2 * std::numbers::pi_v<float> * p.y;
  return {r * std::cos(angle), r * std::sin(angle)};
}

/// Where a ray met the scene and what is there.
struct Spot {
  Vec3 point;
  Vec3 facet;   // unit normal of what was hit, to the viewer
  Vec3 normal;  // of the smooth surface, to the viewer
  Color color;
  float gloss;
};

struct Lights {
  Vec3 up, key;
};

class Shader {
 public:
  Shader(const Scene& scene, const Rays& rays) : scene_(scene), rays_(rays) {}

  Spot spot(const Hit& hit, const Vec3& origin, const Vec3& direction) const {
    Spot s;
    s.facet = hit.normal.dot(direction) > 0 ? Vec3(-hit.normal) : hit.normal;
    if (hit.kind == Hit::Kind::triangle) {
      surface(hit, s);
      return s;
    }
    const bool ball = hit.kind == Hit::Kind::sphere;
    s.point = origin + hit.distance * direction;
    s.normal = s.facet;
    s.color = ball ? scene_.ball_colors[hit.item] : scene_.capsule_colors[hit.item];
    s.gloss = ball ? 0.30f : 0.08f;
    return s;
  }

  Color shade(const Spot& s, const Vec3& to_eye, const Lights& lights, const Sequence& sky,
              const Sequence& lamp, std::uint32_t sample) const {
    const Vec3 start = s.point + kClear * s.facet;
    const Frame frame(s.normal);
    float ambient = 0;
    for (std::uint32_t k = 0; k < kSkyRays; ++k) {
      const std::uint32_t i = kSkyRays * sample + k;
      const Eigen::Vector2f d = on_disc(sky(i));
      Vec3 out = frame.at(d[0], d[1], std::sqrt(std::max(0.f, 1 - d.squaredNorm())));
      const float height = out.dot(s.facet);  // the smooth surface sees a little below the facet's horizon
      if (height < 0) out -= 2 * height * s.facet;
      const float reach = kSkyReach * std::sqrt(sky.line(i)) + 0.01f;
      if (!rays_.any(start, out, 0, reach)) ambient += 0.80f + 0.26f * out.dot(lights.up);
    }
    float lit = 0;
    for (std::uint32_t k = 0; k < kLightRays; ++k) {
      const Eigen::Vector2f d = 0.35f * on_disc(lamp(kLightRays * sample + k));
      const Vec3 out = Frame(lights.key).at(d[0], d[1], 1).normalized();
      const float cosine = s.normal.dot(out);
      if (cosine > 0 && (s.facet.dot(out) <= 0 || !rays_.any(start, out, 0, kFar))) lit += cosine;
    }
    ambient /= kSkyRays;
    lit /= kLightRays;
    const Vec3 half = (lights.key + to_eye).normalized();
    const float shine = s.gloss * std::pow(std::max(0.f, half.dot(s.normal)), 40.f) * std::min(1.f, 2 * lit);
    return s.color * (0.64f * ambient + 0.50f * lit) + Color::Constant(shine);
  }

 private:
  void surface(const Hit& hit, Spot& s) const {
    const core::TriangleMesh& mesh = scene_.body.mesh;
    const core::Triangle& t = mesh.triangle(hit.item);
    const std::array<float, 3> w = {1 - hit.u - hit.v, hit.u, hit.v};
    std::array<Vec3, 3> corner, normal;
    Vec3 sum = Vec3::Zero();
    s.point = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      corner[i] = mesh.position(t[i]).cast<float>();
      normal[i] = scene_.body.normals[t[i]].cast<float>();
      s.point += w[i] * corner[i];
      sum += w[i] * normal[i];
    }
    const float side = sum.dot(s.facet) < 0 ? -1.f : 1.f;
    const float length = sum.norm();
    s.normal = length > 1e-6f ? Vec3(sum * (side / length)) : s.facet;
    // Rays leave from the smooth surface that the normals speak of, which runs above the facets where it bulges
    // (Hanika 2021): else the facets' edges would show in the shadows.
    Vec3 lift = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      const float below = std::min(0.f, side * (s.point - corner[i]).dot(normal[i]));
      lift -= w[i] * below * side * normal[i];
    }
    s.point += lift;
    s.gloss = 0.03f;
    if (const auto* values = std::get_if<ValueColors>(&scene_.surface)) {
      s.color = values->map(w[0] * values->values[t[0]] + w[1] * values->values[t[1]] + w[2] * values->values[t[2]]);
    } else if (const auto* regions = std::get_if<RegionColors>(&scene_.surface)) {
      const std::size_t largest = std::max_element(w.begin(), w.end()) - w.begin();
      s.color = regions->palette[regions->corner[3 * std::size_t{hit.item} + largest]];
    } else {
      s.color = std::get<Color>(scene_.surface);
    }
  }

  const Scene& scene_;
  const Rays& rays_;
};

/// Sums of a pixel's samples.
struct Pixel {
  Color color = Color::Zero();
  int covered = 0;
};

void store(const Pixel& pixel, int samples, bool transparent, std::uint8_t* bytes) {
  Color color = pixel.color;
  if (transparent) {
    if (pixel.covered == 0) return;
    color /= static_cast<float>(pixel.covered);
    bytes[3] = static_cast<std::uint8_t>(std::lround(255. * pixel.covered / samples));
  } else {
    color += Color::Constant(static_cast<float>(samples - pixel.covered));
    color /= static_cast<float>(samples);
  }
  const auto rgb = to_bytes(color);
  std::copy(rgb.begin(), rgb.end(), bytes);
}

}  // namespace

Tracer::Tracer(const Scene& scene) : scene_(scene), rays_(scene.body.mesh, scene.balls, scene.capsules) {}

Image Tracer::trace(const Camera& camera, const TraceOptions& options, const core::Progress& progress) const {
  if (options.samples < 1 || options.samples > 1024)
    throw core::InvalidArgument("a picture takes 1 to 1024 samples a pixel, not " + std::to_string(options.samples));
  Image image(options.size, options.transparent);
  const auto [width, height] = options.size;
  const FilmWindow& window = options.window;
  const Vec3 eye = camera.eye.cast<float>();
  const Lights lights{camera.up.cast<float>(),
                      (-0.50 * camera.right + 0.62 * camera.up + 0.60 * camera.back).normalized().cast<float>()};
  const Shader shader(scene_, rays_);

  const auto trace_pixel = [&](int x, int y) {
    const std::uint32_t place = mixed(static_cast<std::uint32_t>(y) * 0x10001u + static_cast<std::uint32_t>(x));
    const Sequence film(place ^ 0x68bc21ebu), sky(place ^ 0x02e5be93u), lamp(place ^ 0x967a889bu);
    Pixel pixel;
    for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(options.samples); ++s) {
      const Sequence::Pair shift = film(s);
      const double fx = window.x0 + (window.x1 - window.x0) * (x + shift.x) / width;
      const double fy = window.y1 - (window.y1 - window.y0) * (y + shift.y) / height;
      const Vec3 direction = camera.direction(fx, fy).normalized().cast<float>();
      Hit hit;
      if (!rays_.first(eye, direction, 0, kFar, hit)) continue;
      ++pixel.covered;
      const Spot spot = shader.spot(hit, eye, direction);
      const Color color = options.shaded ? shader.shade(spot, -direction, lights, sky, lamp, s) : spot.color;
      pixel.color += color.cwiseMin(1.f);
    }
    store(pixel, options.samples, options.transparent, image.pixel(x, y));
  };

  const int columns = (width + kTile - 1) / kTile;
  const int rows = (height + kTile - 1) / kTile;
  constexpr int kBands = 20;  // between which progress is told
  for (int band = 0; band < kBands; ++band) {
    progress.update("rays", static_cast<double>(band) / kBands);
    const int first = rows * band / kBands;
    const int last = rows * (band + 1) / kBands;
    core::parallel_for(first * columns, last * columns, 1, [&](std::size_t tile, std::size_t) {
      progress.throw_if_cancelled();
      const int x0 = static_cast<int>(tile % columns) * kTile;
      const int y0 = static_cast<int>(tile / columns) * kTile;
      for (int y = y0; y < std::min(y0 + kTile, height); ++y)
        for (int x = x0; x < std::min(x0 + kTile, width); ++x) trace_pixel(x, y);
    });
  }
  return image;
}

}  // namespace morsel::tools::render
