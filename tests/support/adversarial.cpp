#include "support/adversarial.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>
#include <utility>

#include "support/molecules.h"

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

std::vector<std::array<Index, 2>> colliding_edges(std::size_t count) {
  // The hash has bits 20 and above of (smaller · 2³² + larger) · factor.
  std::vector<std::array<Index, 2>> edges;
  for (Index i = 0; i < count; ++i) edges.push_back({4096 * i, 4'000'000'000});
  return edges;
}

std::vector<Point> comb(std::size_t corners) {
  std::mt19937 random(1);
  std::vector<Point> polygon;
  const auto teeth = static_cast<int>(corners / 2) - 1;
  for (int i = 0; i < teeth; ++i) {
    polygon.emplace_back(i, 0, 0);
    polygon.emplace_back(i + 0.5, 1000 + 1e-3 * (random() % 10'000), 0);
  }
  polygon.emplace_back(teeth, 2000, 0);
  polygon.emplace_back(-1, 2000, 0);
  return polygon;
}

std::vector<Point> maze(std::size_t corners, unsigned seed) {
  struct Cell {
    std::array<bool, 4> open{};  // to the right, up, to the left, down
    bool visited = false;
  };
  const auto width = static_cast<int>(std::sqrt(static_cast<double>(corners) / 4));
  constexpr std::array<int, 4> kX = {1, 0, -1, 0}, kY = {0, 1, 0, -1};
  std::mt19937 random(seed);
  std::vector<Cell> cells(static_cast<std::size_t>(width) * width);
  const auto at = [&](int x, int y) -> Cell& { return cells[static_cast<std::size_t>(y) * width + x]; };
  std::vector<std::array<int, 2>> path = {{0, 0}};
  at(0, 0).visited = true;
  while (!path.empty()) {  // a random spanning tree of the cells
    const auto [x, y] = path.back();
    const unsigned turn = random() % 4;
    bool moved = false;
    for (unsigned i = 0; i < 4 && !moved; ++i) {
      const unsigned side = (turn + i) % 4;
      const int nx = x + kX[side], ny = y + kY[side];
      if (nx < 0 || ny < 0 || nx >= width || ny >= width || at(nx, ny).visited) continue;
      at(x, y).open[side] = at(nx, ny).open[(side + 2) % 4] = at(nx, ny).visited = moved = true;
      path.push_back({nx, ny});
    }
    if (!moved) path.pop_back();
  }
  // Its outline, counter-clockwise: corner k of a cell lies before its side k.
  constexpr std::array<double, 4> kCornerX = {0.3, 0.3, -0.3, -0.3}, kCornerY = {-0.3, 0.3, 0.3, -0.3};
  const auto jitter = [&] { return 1e-5 * (random() % 100); };
  std::vector<Point> polygon;
  int x = 0, y = 0;
  unsigned k = 0;
  do {
    polygon.emplace_back(x + kCornerX[k] + jitter(), y + kCornerY[k] + jitter(), 0);
    if (at(x, y).open[k]) {
      x += kX[k];
      y += kY[k];
      k = (k + 3) % 4;
    } else {
      k = (k + 1) % 4;
    }
  } while (x != 0 || y != 0 || k != 0);
  return polygon;
}

std::vector<PolygonFamily> simple_polygons() {
  const auto around = [](double angle, double radius) {
    return Point(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  return {{"star",
           [=](std::size_t corners) {
             std::vector<Point> polygon;
             for (std::size_t i = 0; i < corners; ++i)
               polygon.push_back(
                   around(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners),
                          i % 2 == 0 ? 1 : 0.9));
             return polygon;
           }},
          {"ragged disc",
           [=](std::size_t corners) {
             std::mt19937 random(1);
             std::vector<Point> polygon;
             for (std::size_t i = 0; i < corners; ++i)
               polygon.push_back(
                   around(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners),
                          1 + static_cast<double>(random() % 1000) / 200));
             return polygon;
           }},
          {"spiral",
           [=](std::size_t corners) {
             std::vector<Point> polygon, inner;
             for (std::size_t i = 0; i < corners / 2; ++i) {
               const double angle = 0.2 * static_cast<double>(i);
               polygon.push_back(around(angle, 2 + 0.2 * angle));
               inner.push_back(around(angle, 1.5 + 0.2 * angle));
             }
             polygon.insert(polygon.end(), inner.rbegin(), inner.rend());
             return polygon;
           }},
          {"comb", comb},
          {"teeth above a bent side",  // the bounding boxes of its corners all meet
           [](std::size_t corners) {
             std::mt19937 random(1);
             std::vector<Point> polygon;
             const auto add = [&](double x, double y) {
               polygon.emplace_back(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, 0);
             };
             const std::size_t n = corners / 2;
             const auto at = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(n); };
             for (std::size_t i = 0; i < n; ++i) add(at(i), 4e-3 * at(i) * (1 - at(i)));
             for (std::size_t i = n; i > 0; --i) add(at(i), 1.1e-3 + 1e-6 * (random() % 1000));
             return polygon;
           }},
          {"maze", [](std::size_t corners) { return maze(corners, 1); }}};
}

std::string pdb_of_frames(std::size_t count) {
  const std::string frame = pdb_line({}, 1) + "ENDMDL\n";
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += frame;
  return text;
}

std::string pdb_of_alternating_chains(std::size_t count) {
  std::string text;
  AtomLine atom;
  for (std::size_t i = 0; i < count; ++i) {
    atom.chain = i % 2 == 1 ? (i < count / 2 ? "B" : "A") : (i < count / 2 ? "A" : "Z");
    atom.position.x() = 0.01 * static_cast<double>(i);
    text += pdb_line(atom, 1);
  }
  return text;
}

std::string mmcif_of_models(std::size_t count) {
  std::vector<AtomLine> atoms(count);
  for (std::size_t i = 0; i < count; ++i) {
    atoms[i].model = static_cast<int>(i) + 1;
    atoms[i].chain = "C" + std::to_string(i);
  }
  return mmcif_text(atoms);
}

std::string cif_of_blocks(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += "data_b" + std::to_string(i) + "\n_a.b 1\n";
  return text;
}

Soup book(std::size_t pages) {
  Soup soup{{{0, 0, 0}, {0, 0, 1}}, {}};
  for (Index i = 0; i < pages; ++i) {
    soup.positions.emplace_back(std::cos(i), std::sin(i), 0);
    soup.triangles.push_back({0, 1, i + 2});
  }
  return soup;
}

Soup fan(std::size_t triangles) {
  Soup soup{{{0, 0, 1}}, {}};
  const auto n = static_cast<Index>(triangles);
  for (Index i = 0; i < n; ++i) {
    soup.positions.emplace_back(std::cos(2 * std::numbers::pi * i / n),
                                std::sin(2 * std::numbers::pi * i / n), 0);
    soup.triangles.push_back({0, i + 1, (i + 1) % n + 1});
  }
  return soup;
}

Soup duplicates(std::size_t triangles) {
  Soup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  for (std::size_t i = 0; i < triangles; ++i) soup.triangles.push_back({0, 1, 2});
  return soup;
}

Soup apart(std::size_t triangles) {
  Soup soup;
  for (Index i = 0; i < triangles; ++i) {
    for (const Point& p : {Point(i, 0, 0), Point(i, 1, 0), Point(i, 0, 1)}) soup.positions.push_back(p);
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

}  // namespace morsel::test::adversarial
