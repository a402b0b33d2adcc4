#include "morsel/tools/render/tracer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::tools::render {
namespace {

constexpr int kTile = 16;          // pixels
constexpr int kSkyRays = 4;        // a sample
constexpr int kLampRays = 2;       // a sample
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

/// Low-discrepancy points of the unit square or line, from a given start. In whole numbers, so
/// that they are the same everywhere.
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

/// The intersection of a ray with the scene.
struct Spot {
  Vec3 point;
  Vec3 facet;   // unit normal of what was hit, to the viewer
  Vec3 normal;  // of the smooth surface, to the viewer
  Color color;
  float gloss;
};

/// The light at a point: a factor of its colour, and the specular part.
struct Light {
  float diffuse = 0;
  float shine = 0;
};

struct Lights {
  explicit Lights(const Camera& camera)
      : up(camera.up.cast<float>()),
        key((-0.50 * camera.right + 0.62 * camera.up + 0.60 * camera.back).normalized().cast<float>()),
        half((key.normal + camera.back.cast<float>()).normalized()) {}
  Vec3 up;
  Frame key;  // towards the lamp
  Vec3 half;  // halfway between lamp and viewer
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

  /// The light that reaches a point, by `sky_rays` and `lamp_rays` from number `first` of their sequences on.
  Light light(const Spot& s, const Lights& lights, const Sequence& sky, const Sequence& lamp,
              std::uint32_t first, std::uint32_t sky_rays, std::uint32_t lamp_rays) const {
    const Vec3 start = s.point + kClear * s.facet;
    const Frame frame(s.normal);
    Light result;
    for (std::uint32_t i = first * sky_rays; i < (first + 1) * sky_rays; ++i) {
      const Eigen::Vector2f d = on_disc(sky(i));
      Vec3 out = frame.at(d[0], d[1], std::sqrt(std::max(0.f, 1 - d.squaredNorm())));
      const float height = out.dot(s.facet);  // the smooth surface's horizon is slightly below the facet's
      if (height < 0) out -= 2 * height * s.facet;
      const float reach = kSkyReach * std::sqrt(sky.line(i)) + 0.01f;
      if (!rays_.any(start, out, 0, reach)) result.diffuse += 0.80f + 0.26f * out.dot(lights.up);
    }
    float lit = 0;
    for (std::uint32_t i = first * lamp_rays; i < (first + 1) * lamp_rays; ++i) {
      const Eigen::Vector2f d = 0.35f * on_disc(lamp(i));
      const Vec3 out = lights.key.at(d[0], d[1], 1).normalized();
      const float cosine = s.normal.dot(out);
      if (cosine > 0 && (s.facet.dot(out) <= 0 || !rays_.any(start, out, 0, kFar))) lit += cosine;
    }
    lit /= static_cast<float>(lamp_rays);
    result.diffuse = 0.64f * result.diffuse / static_cast<float>(sky_rays) + 0.50f * lit;
    const float glance = std::max(0.f, lights.half.dot(s.normal));
    result.shine = s.gloss * std::pow(glance, 40.f) * std::min(1.f, 2 * lit);
    return result;
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
    // Rays start on the smooth surface that the normals describe, which is above the facets where it is
    // convex (Hanika 2021): else the facets' edges would be visible in the shadows.
    Vec3 lift = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      const float below = std::min(0.f, side * (s.point - corner[i]).dot(normal[i]));
      lift -= w[i] * below * side * normal[i];
    }
    s.point += lift;
    s.gloss = 0.03f;
    if (const auto* values = std::get_if<ValueColors>(&scene_.surface)) {
      s.color = values->map(w[0] * values->values[t[0]] + w[1] * values->values[t[1]] +
                            w[2] * values->values[t[2]]);
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

/// A pixel as it was sampled. `even` ones show one piece of surface of about one colour: their light may be
/// smoothed.
struct Pixel {
  Color color = Color::Zero();  // sum; of even pixels without light
  Vec3 normal = Vec3::Zero();   // of even pixels: at their first sample
  Vec3 point = Vec3::Zero();
  Light light;  // mean
  int covered = 0;
  int samples = 0;
  bool even = false;
};

/// Samples one pixel after the other: a few first; where these differ, all.
class Sampler {
 public:
  Sampler(const Scene& scene, const Rays& rays, const Camera& camera, const TraceOptions& options)
      : shader_(scene, rays),
        rays_(rays),
        camera_(camera),
        options_(options),
        lights_(camera),
        eye_(camera.eye.cast<float>()) {}

  Pixel sample(int x, int y) const {
    const std::uint32_t place =
        mixed(static_cast<std::uint32_t>(y) * 0x10001u + static_cast<std::uint32_t>(x));
    const Sequence film(place);
    // The pixels of each block of 4 x 4 share out consecutive stretches of one sequence, so that what
    // smoothed() averages is spread as evenly as if it were one pixel's.
    const Sequence sky(0x02e5be93u), lamp(0x967a889bu);
    const std::uint32_t block = static_cast<std::uint32_t>(x & 3) + 4 * static_cast<std::uint32_t>(y & 3);
    const int few = std::min(options_.samples, std::max(4, options_.samples / 4));
    std::array<Spot, 256> spots;
    Pixel pixel;
    for (; pixel.samples < few; ++pixel.samples) {
      Spot& spot = spots[static_cast<std::size_t>(pixel.covered)];
      if (look(x, y, film(static_cast<std::uint32_t>(pixel.samples)), spot)) ++pixel.covered;
    }
    if (pixel.covered == 0) {
      // It may still contain a corner.
      for (; pixel.samples < options_.samples && pixel.covered == 0; ++pixel.samples)
        if (look(x, y, film(static_cast<std::uint32_t>(pixel.samples)), spots[0])) ++pixel.covered;
      if (pixel.covered == 0) return pixel;
    }
    pixel.even = pixel.covered == few && are_alike({spots.data(), static_cast<std::size_t>(few)});
    pixel.normal = spots[0].normal;
    pixel.point = spots[0].point;
    const auto collect = [&](const Spot& spot, std::uint32_t number) {
      const Light light = options_.shaded ? shader_.light(spot, lights_, sky, lamp,
                                                          block * static_cast<std::uint32_t>(few) + number,
                                                          kSkyRays, pixel.even ? 1 : kLampRays)
                                          : Light{1, 0};
      if (pixel.even) {
        pixel.color += spot.color;
        pixel.light.diffuse += light.diffuse;
        pixel.light.shine += light.shine;
      } else {
        pixel.color += lit(spot.color, light);
      }
    };
    for (int i = 0; i < pixel.covered; ++i)
      collect(spots[static_cast<std::size_t>(i)], static_cast<std::uint32_t>(i));
    if (pixel.even) {
      pixel.light.diffuse /= static_cast<float>(few);
      pixel.light.shine /= static_cast<float>(few);
      return pixel;
    }
    for (; pixel.samples < options_.samples; ++pixel.samples) {
      if (!look(x, y, film(static_cast<std::uint32_t>(pixel.samples)), spots[0])) continue;
      collect(spots[0], static_cast<std::uint32_t>(pixel.covered));
      ++pixel.covered;
    }
    return pixel;
  }

  static Color lit(const Color& color, const Light& light) {
    return (color * light.diffuse + Color::Constant(light.shine)).cwiseMin(1.f);
  }

 private:
  bool look(int x, int y, const Sequence::Pair& shift, Spot& spot) const {
    const FilmWindow& window = options_.window;
    const double fx = window.x0 + (window.x1 - window.x0) * (x + double{shift.x}) / options_.size.width;
    const double fy = window.y1 - (window.y1 - window.y0) * (y + double{shift.y}) / options_.size.height;
    const Vec3 direction = camera_.direction(fx, fy).normalized().cast<float>();
    Hit hit;
    if (!rays_.first(eye_, direction, 0, kFar, hit)) return false;
    spot = shader_.spot(hit, eye_, direction);
    return true;
  }

  static bool are_alike(std::span<const Spot> spots) {
    return std::all_of(spots.begin(), spots.end(), [&](const Spot& s) {
      return s.gloss == spots[0].gloss && s.normal.dot(spots[0].normal) > 0.985f &&
             (s.color - spots[0].color).cwiseAbs().maxCoeff() < 0.02f &&
             std::abs((s.point - spots[0].point).dot(spots[0].normal)) < 0.004f;
    });
  }

  const Shader shader_;
  const Rays& rays_;
  const Camera& camera_;
  const TraceOptions& options_;
  const Lights lights_;
  const Vec3 eye_;
};

/// The light of an even pixel averaged with that of its even neighbours that face the same way and lie in one
/// plane with it, so that the few rays of each leave no noise.
float smoothed(const std::vector<Pixel>& pixels, Size size, int x, int y) {
  constexpr int kReach = 3;
  constexpr std::array<float, kReach + 1> kWeight = {1, 0.75f, 0.5f,
                                                     0.25f};  // each of a block's pixels counts alike
  const Pixel& here = pixels[static_cast<std::size_t>(y) * size.width + x];
  float sum = 0, weights = 0;
  for (int j = std::max(0, y - kReach); j <= std::min(size.height - 1, y + kReach); ++j)
    for (int i = std::max(0, x - kReach); i <= std::min(size.width - 1, x + kReach); ++i) {
      const Pixel& there = pixels[static_cast<std::size_t>(j) * size.width + i];
      if (!there.even) continue;
      const float turn = here.normal.dot(there.normal);
      const Vec3 way = there.point - here.point;
      const float off = std::abs(way.dot(here.normal));
      if (turn < 0.9f || off > 0.0005f + 0.35f * way.norm()) continue;
      const float weight = kWeight[std::abs(i - x)] * kWeight[std::abs(j - y)] * (turn - 0.9f);
      sum += weight * there.light.diffuse;
      weights += weight;
    }
  return sum / weights;  // the pixel itself is one of them
}

void store(const Color& sum, int covered, int samples, bool transparent, std::uint8_t* bytes) {
  Color color = sum;
  if (transparent) {
    if (covered == 0) return;
    color /= static_cast<float>(covered);
    bytes[3] = static_cast<std::uint8_t>(std::lround(255. * covered / samples));
  } else {
    color += Color::Constant(static_cast<float>(samples - covered));
    color /= static_cast<float>(samples);
  }
  const auto rgb = to_bytes(color);
  std::copy(rgb.begin(), rgb.end(), bytes);
}

}  // namespace

Tracer::Tracer(const Scene& scene) : scene_(scene), rays_(scene.body.mesh, scene.balls, scene.capsules) {}

Image Tracer::trace(const Camera& camera, const TraceOptions& options, const core::Progress& progress) const {
  if (options.samples < 1 || options.samples > 1024)
    throw core::InvalidArgument("a picture takes 1 to 1024 samples a pixel, not " +
                                std::to_string(options.samples));
  const int width = options.size.width;
  const int height = options.size.height;
  Image image(options.size, options.transparent);
  std::vector<Pixel> pixels(static_cast<std::size_t>(width) * height);
  const Sampler sampler(scene_, rays_, camera, options);
  const int columns = (width + kTile - 1) / kTile;
  const int rows = (height + kTile - 1) / kTile;
  constexpr int kBands = 20;  // between which progress is reported
  for (int band = 0; band < kBands; ++band) {
    progress.update("rays", static_cast<double>(band) / kBands);
    const int first = rows * band / kBands;
    const int last = rows * (band + 1) / kBands;
    core::parallel_for(static_cast<std::size_t>(first) * columns, static_cast<std::size_t>(last) * columns, 1,
                       [&](std::size_t tile, std::size_t) {
                         progress.throw_if_cancelled();
                         const int x0 = static_cast<int>(tile % columns) * kTile;
                         const int y0 = static_cast<int>(tile / columns) * kTile;
                         for (int y = y0; y < std::min(y0 + kTile, height); ++y)
                           for (int x = x0; x < std::min(x0 + kTile, width); ++x)
                             pixels[static_cast<std::size_t>(y) * width + x] = sampler.sample(x, y);
                       });
  }
  core::parallel_for(0, static_cast<std::size_t>(height), 16, [&](std::size_t first, std::size_t last) {
    for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y)
      for (int x = 0; x < width; ++x) {
        const Pixel& p = pixels[static_cast<std::size_t>(y) * width + x];
        const Color sum =
            p.even ? Color(p.samples * Sampler::lit(p.color / static_cast<float>(p.samples),
                                                    {smoothed(pixels, options.size, x, y), p.light.shine}))
                   : p.color;
        store(sum, p.covered, std::max(1, p.samples), options.transparent, image.pixel(x, y));
      }
  });
  return image;
}

}  // namespace morsel::tools::render
