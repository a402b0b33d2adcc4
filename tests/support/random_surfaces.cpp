#include "support/random_surfaces.h"

#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include "morsel/core/mesh/mesh_defects.h"

namespace morsel::test {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  int between(int low, int high) { return low + below(high - low + 1); }

 private:
  std::mt19937 engine_;
};

Soup some_surface(Random& random) {
  switch (random.below(9)) {
    case 0:
      return tetrahedron();
    case 1:
      return octahedron();
    case 2:
      return sphere(1);
    case 3:
      return bipyramid(random.between(3, 20));
    case 4:
      return wheel(random.between(3, 12));
    case 5:
      return torus(random.between(3, 7), random.between(3, 7));
    case 6:
      return pierced_slab(random.between(1, 2));
    case 7:
      return annulus(random.between(3, 8), random.between(2, 5));
    default:
      return grid(random.between(2, 8), random.between(2, 8));
  }
}

/// Turns the edge between two triangles into the other diagonal, if that keeps all edges simple.
void flip_edges(Soup& soup, int tries, Random& random) {
  std::set<std::pair<Index, Index>> edges;
  const auto key = [](Index a, Index b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (const auto& t : soup.triangles)
    for (int i = 0; i < 3; ++i) edges.insert(key(t[i], t[(i + 1) % 3]));
  const int count = static_cast<int>(soup.triangles.size());
  for (int k = 0; k < tries; ++k) {
    core::Triangle& s = soup.triangles[random.below(count)];
    const int i = random.below(3);
    const Index a = s[i], b = s[(i + 1) % 3], c = s[(i + 2) % 3];
    for (core::Triangle& t : soup.triangles)
      for (int j = 0; j < 3; ++j) {
        if (t[j] != b || t[(j + 1) % 3] != a) continue;
        const Index d = t[(j + 2) % 3];
        if (c == d || edges.contains(key(c, d))) continue;
        edges.erase(key(a, b));
        edges.insert(key(c, d));
        s = {c, a, d};
        t = {d, b, c};
        j = 3;
      }
  }
}

bool is_mesh(const Soup& soup) { return core::find_defects(soup.positions, soup.triangles).empty(); }

}  // namespace

TriangleMesh random_surface(unsigned seed) {
  Random random(seed);
  Soup soup = some_surface(random);
  if (random.below(5) == 0) soup = together(soup, some_surface(random));
  if (random.below(2) == 0) flip_edges(soup, random.between(1, 60), random);
  if (random.below(2) == 0)
    for (int k = random.between(1, 8); k > 0; --k) {
      Soup holed = soup;
      const int count = static_cast<int>(soup.triangles.size());
      holed.triangles.erase(holed.triangles.begin() + random.below(count));
      if (is_mesh(holed)) soup = std::move(holed);
    }
  return shuffled(soup, seed + 1).mesh();
}

}  // namespace morsel::test
