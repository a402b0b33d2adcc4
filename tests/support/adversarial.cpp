#include "support/adversarial.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <utility>

namespace morsel::test::adversarial {
namespace {

constexpr std::uint64_t kFactor = 0x9E37'79B9'7F4A'7C15;

/// The factor's inverse modulo 2⁶⁴ (Newton: each step doubles the number of right bits, three at first).
constexpr std::uint64_t inverse(std::uint64_t odd) {
  std::uint64_t result = odd;
  for (int i = 0; i < 5; ++i) result *= 2 - odd * result;
  return result;
}

/// One step of the hash.
std::uint64_t mixed(std::uint64_t hash, double coordinate) {
  hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate)) * kFactor;
  return hash ^ hash >> 32;
}

std::string ply(std::size_t properties, std::size_t elements) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  for (std::size_t i = 0; i < properties; ++i) text += "property float p" + std::to_string(i) + '\n';
  text += "element face 1\nproperty list uchar int vertex_indices\n";
  for (std::size_t i = 0; i < elements; ++i) text += "element e" + std::to_string(i) + " 0\nproperty int p\n";
  text += "end_header\n";
  for (const char* position : {"0 0 0", "1 0 0", "0 1 0"}) {
    text += position;
    for (std::size_t i = 0; i < properties; ++i) text += " 0";
    text += '\n';
  }
  return text + "3 0 1 2\n";
}

}  // namespace

std::string ply_with_properties(std::size_t count) { return ply(count, 0); }

std::string ply_with_elements(std::size_t count) { return ply(0, count); }

std::vector<Point> colliding_points(std::size_t count) {
  static constexpr std::uint64_t kInverse = inverse(kFactor);
  static_assert(kFactor * kInverse == 1);
  const std::uint64_t before = mixed(mixed(0, 1), 1);
  std::vector<Point> points;
  for (std::uint64_t high = 0; points.size() < count; ++high) {
    std::uint64_t hash = high << 24;
    hash ^= hash >> 32;  // undoes the shift of the last step
    const double z = std::bit_cast<double>((hash * kInverse) ^ before);
    if (std::abs(z) > 1e-3 && std::abs(z) < 1e3) points.emplace_back(1, 1, z);
  }
  return points;
}

std::string ascii_stl(const std::vector<Point>& points) {
  std::string text = "solid s\n";
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (std::size_t k = i; k < i + 3; ++k) {
      std::array<char, 100> line;
      std::snprintf(line.data(), line.size(), "vertex %.17g %.17g %.17g\n", points[k].x(), points[k].y(),
                    points[k].z());
      text += line.data();
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

TriangleMesh tetrahedra(std::size_t count) {
  const Soup one = tetrahedron();
  Soup all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<Index>(all.positions.size());
    for (const Point& p : one.positions)
      all.positions.push_back(p + Point(3.0 * static_cast<double>(i), 0, 0));
    for (const core::Triangle& t : one.triangles)
      all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return all.mesh();
}

TriangleMesh pierced_sheet(std::size_t holes) {
  const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(holes))));
  Soup sheet = grid(3 * side + 1, 3 * side + 1);
  std::vector<core::Triangle> kept;
  const std::size_t columns = 3 * static_cast<std::size_t>(side);
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const std::size_t square = t / 2;
    if (square % columns % 3 != 1 || square / columns % 3 != 1) kept.push_back(sheet.triangles[t]);
  }
  sheet.triangles = std::move(kept);
  std::mt19937_64 random(1);
  for (Point& p : sheet.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] += 0.01 * static_cast<double>(random() >> 11) * 0x1p-53;
  return sheet.mesh();
}

}  // namespace morsel::test::adversarial
