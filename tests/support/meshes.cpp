#include "support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

namespace morsel::test {

core::PolygonSoup Soup::polygons() const {
  core::PolygonSoup result;
  result.positions = positions;
  for (const core::Triangle& t : triangles) result.add_polygon(t);
  return result;
}

namespace {

constexpr double kTau = 2 * std::numbers::pi;

Index u(int i) { return static_cast<Index>(i); }

/// Drops unused vertices, keeping the order of the others.
Soup compacted(const Soup& soup) {
  std::vector<Index> number(soup.positions.size(), core::kNone);
  for (const auto& t : soup.triangles)
    for (const Index v : t) number[v] = 0;
  Soup result;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      number[v] = static_cast<Index>(result.positions.size());
      result.positions.push_back(soup.positions[v]);
    }
  for (const auto& t : soup.triangles) result.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return result;
}

}  // namespace

Soup tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

Soup octahedron() {
  return {{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
          {{0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 2}, {1, 3, 2}, {1, 4, 3}, {1, 5, 4}, {1, 2, 5}}};
}

Soup single_triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

Soup square_pair() { return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

Soup wheel(int spokes) {
  Soup soup{{{0, 0, 0}}, {}};
  for (int i = 0; i < spokes; ++i) {
    const double a = kTau * i / spokes;
    soup.positions.emplace_back(std::cos(a), std::sin(a), 0);
    soup.triangles.push_back({0, u(1 + i), u(1 + (i + 1) % spokes)});
  }
  return soup;
}

Soup bipyramid(int sides) {
  Soup soup{{{0, 0, 1}, {0, 0, -1}}, {}};
  for (int i = 0; i < sides; ++i) {
    const double a = kTau * i / sides;
    soup.positions.emplace_back(std::cos(a), std::sin(a), 0);
    const Index here = u(2 + i);
    const Index next = u(2 + (i + 1) % sides);
    soup.triangles.push_back({0, here, next});
    soup.triangles.push_back({1, next, here});
  }
  return soup;
}

Soup sphere(int subdivisions) {
  const double g = std::numbers::phi;
  Soup soup{{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Point& p : soup.positions) p.normalize();
  for (int s = 0; s < subdivisions; ++s) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto midpoint = [&](Index a, Index b) {
      const auto [entry, is_new] =
          middle.try_emplace(std::minmax(a, b), static_cast<Index>(soup.positions.size()));
      if (is_new) soup.positions.push_back((soup.positions[a] + soup.positions[b]).normalized());
      return entry->second;
    };
    std::vector<core::Triangle> finer;
    for (const auto& [a, b, c] : soup.triangles) {
      const Index ab = midpoint(a, b);
      const Index bc = midpoint(b, c);
      const Index ca = midpoint(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    soup.triangles = std::move(finer);
  }
  return soup;
}

Soup torus(int around, int along) {
  Soup soup;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const double a = kTau * i / around;
      const double b = kTau * j / along;
      const double r = 2 + std::cos(b);
      soup.positions.emplace_back(r * std::cos(a), r * std::sin(a), std::sin(b));
      const Index v00 = u(i * along + j);
      const Index v10 = u((i + 1) % around * along + j);
      const Index v01 = u(i * along + (j + 1) % along);
      const Index v11 = u((i + 1) % around * along + (j + 1) % along);
      soup.triangles.push_back({v00, v10, v11});
      soup.triangles.push_back({v00, v11, v01});
    }
  return soup;
}

Soup grid(int columns, int rows) {
  Soup soup;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) soup.positions.emplace_back(j, i, 0);
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j + 1 < columns; ++j) {
      const Index v = u(i * columns + j);
      const Index above = v + u(columns);
      soup.triangles.push_back({v, v + 1, above + 1});
      soup.triangles.push_back({v, above + 1, above});
    }
  return soup;
}

Soup annulus(int around, int rings) {
  Soup soup;
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < around; ++i) {
      const double a = kTau * i / around;
      soup.positions.emplace_back((r + 1) * std::cos(a), (r + 1) * std::sin(a), 0);
      if (r + 1 == rings) continue;
      const Index here = u(r * around + i);
      const Index next = u(r * around + (i + 1) % around);
      soup.triangles.push_back({here, here + u(around), next + u(around)});
      soup.triangles.push_back({here, next + u(around), next});
    }
  return soup;
}

Soup pierced_slab(int holes) {
  const int columns = 2 * holes + 1;
  const auto solid = [&](int x, int y, int z) {
    if (x < 0 || x >= columns || y < 0 || y >= 3 || z != 0) return false;
    return !(y == 1 && x % 2 == 1);
  };
  std::map<std::array<int, 3>, Index> corners;
  Soup soup;
  const auto corner = [&](std::array<int, 3> c) {
    const auto [entry, is_new] = corners.try_emplace(c, static_cast<Index>(soup.positions.size()));
    if (is_new) soup.positions.emplace_back(c[0], c[1], c[2]);
    return entry->second;
  };
  for (int x = 0; x < columns; ++x)
    for (int y = 0; y < 3; ++y) {
      if (!solid(x, y, 0)) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
          std::array<int, 3> cell = {x, y, 0};
          std::array<int, 3> other = cell;
          other[axis] += side == 1 ? 1 : -1;
          if (solid(other[0], other[1], other[2])) continue;
          const int p = (axis + 1) % 3;
          const int q = (axis + 2) % 3;
          std::array<int, 3> c00 = cell;
          c00[axis] += side;
          std::array<int, 3> c10 = c00, c11 = c00, c01 = c00;
          ++c10[p], ++c11[p], ++c11[q], ++c01[q];
          Index a = corner(c00), b = corner(c10), c = corner(c11), d = corner(c01);
          if (side == 0) std::swap(b, d);
          soup.triangles.push_back({a, b, c});
          soup.triangles.push_back({a, c, d});
        }
    }
  return soup;
}

Soup punctured_sphere(int subdivisions, int holes) {
  Soup soup = sphere(subdivisions);
  // The twelve vertices of the icosahedron are far from each other once it is subdivided.
  if (holes > 12 || subdivisions < 2)
    throw std::logic_error("punctured_sphere: at most 12 holes, 2 subdivisions");
  std::erase_if(soup.triangles, [&](const core::Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](Index v) { return v < u(holes); });
  });
  return compacted(soup);
}

Soup moebius(int around) {
  Soup soup;
  for (int i = 0; i < around; ++i)
    for (int side = 0; side < 2; ++side) {
      const double a = kTau * i / around;
      const double w = side == 0 ? -0.3 : 0.3;
      const double r = 1 + w * std::cos(a / 2);
      soup.positions.emplace_back(r * std::cos(a), r * std::sin(a), w * std::sin(a / 2));
    }
  for (int i = 0; i < around; ++i) {
    const bool last = i + 1 == around;
    const Index a = u(2 * i), b = u(2 * i + 1);
    const Index c = last ? 1 : u(2 * i + 2), d = last ? 0 : u(2 * i + 3);
    soup.triangles.push_back({a, c, d});
    soup.triangles.push_back({a, d, b});
  }
  return soup;
}

Soup together(const Soup& a, const Soup& b) {
  Soup soup = a;
  const auto shift = static_cast<Index>(a.positions.size());
  double right = -1e300, left = 1e300;
  for (const Point& p : a.positions) right = std::max(right, p.x());
  for (const Point& p : b.positions) left = std::min(left, p.x());
  for (const Point& p : b.positions) soup.positions.push_back(p + Point(right - left + 1, 0, 0));
  for (const auto& t : b.triangles) soup.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return soup;
}

Soup shuffled(const Soup& soup, unsigned seed, std::vector<Index>* new_number) {
  std::mt19937 random(seed);
  const auto shuffle = [&](auto& items) {  // std::shuffle differs between libraries
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random() % i]);
  };
  std::vector<Index> number(soup.positions.size());
  std::iota(number.begin(), number.end(), Index{0});
  shuffle(number);
  Soup result;
  result.positions.resize(number.size());
  for (std::size_t v = 0; v < number.size(); ++v) result.positions[number[v]] = soup.positions[v];
  for (const auto& t : soup.triangles) {
    core::Triangle turned = {number[t[0]], number[t[1]], number[t[2]]};
    std::rotate(turned.begin(), turned.begin() + random() % 3, turned.end());
    result.triangles.push_back(turned);
  }
  shuffle(result.triangles);
  if (new_number != nullptr) *new_number = number;
  return result;
}

const std::vector<NamedMesh>& mesh_zoo() {
  static const std::vector<NamedMesh> zoo = {
      {"single triangle", single_triangle().mesh()},
      {"two triangles", square_pair().mesh()},
      {"tetrahedron", tetrahedron().mesh()},
      {"octahedron", octahedron().mesh()},
      {"wheel of 7", wheel(7).mesh()},
      {"bipyramid of 9", bipyramid(9).mesh()},
      {"sphere", sphere(2).mesh()},
      {"shuffled sphere", shuffled(sphere(2), 7).mesh()},
      {"torus", torus(9, 7).mesh()},
      {"genus 2", pierced_slab(2).mesh()},
      {"genus 3", pierced_slab(3).mesh()},
      {"disc", grid(9, 8).mesh()},
      {"annulus", annulus(11, 4).mesh()},
      {"sphere with 5 holes", punctured_sphere(2, 5).mesh()},
      {"sphere and torus", together(sphere(1), torus(6, 5)).mesh()},
      {"annulus, disc and genus 2",
       shuffled(together(together(annulus(7, 3), grid(4, 5)), pierced_slab(2)), 3).mesh()},
  };
  return zoo;
}

std::string sample(const std::string& file) {
  const char* folder = std::getenv("MORSEL_SAMPLES");
  if (folder == nullptr) throw std::runtime_error("MORSEL_SAMPLES is not set: run the tests with tools/test");
  const std::filesystem::path path = std::filesystem::path(folder) / file;
  if (!std::filesystem::exists(path))
    throw std::runtime_error("no sample mesh " + path.string() + ": run tools/samples");
  return path.string();
}

}  // namespace morsel::test
