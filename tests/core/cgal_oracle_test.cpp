// CGAL's readers as an oracle for ours: the same numbers in the same order wherever both take a file.

#define CGAL_DISABLE_GMP 1

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "support/corpus.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;

namespace {

using CgalPoint = CGAL::Simple_cartesian<double>::Point_3;

/// Captures what CGAL prints about files that it refuses.
class Quiet {
 public:
  Quiet() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~Quiet() { std::cerr.rdbuf(before_); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

/// Compares the file as both read it; false if CGAL refuses it.
bool check_against_cgal(const std::string& path) {
  std::vector<CgalPoint> points;
  std::vector<std::vector<std::size_t>> polygons;
  const Quiet quiet;
  if (!CGAL::IO::read_polygon_soup(path, points, polygons)) return false;
  const core::PolygonSoup soup = core::read_polygon_soup(path).soup;
  REQUIRE(soup.positions.size() == points.size());
  REQUIRE(soup.polygon_count() == polygons.size());
  bool same = true;
  for (std::size_t v = 0; v < points.size(); ++v)
    for (int axis = 0; axis < 3; ++axis) same = same && soup.positions[v][axis] == points[v][axis];
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const auto polygon = soup.polygon(p);
    same = same && std::equal(polygon.begin(), polygon.end(), polygons[p].begin(), polygons[p].end());
  }
  CHECK(same);
  return true;
}

}  // namespace

TEST_CASE("sample meshes are read as CGAL reads them") {
  const std::filesystem::path folder = std::filesystem::path(sample("lion-head.off")).parent_path();
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    // prim.off announces one face too few, which CGAL ignores.
    if (entry.path().filename() == "prim.off" || entry.file_size() > 300'000) continue;
    INFO(entry.path());
    CHECK(check_against_cgal(entry.path().string()));
    ++compared;
  }
  CHECK(compared > 80);
}

TEST_CASE("files of the corpus that both take are read as CGAL reads them") {
  int compared = 0;
  for (const CorpusFile& file : mesh_corpus()) {
    // CGAL follows a null pointer where coordinates are neither float nor double, as in these, and reads
    // beyond an array where vertices have texture coordinates.
    if (file.name.starts_with("binary_") && file.name.ends_with(".ply")) continue;
    if (file.name.starts_with("st") && file.name.ends_with("off.off")) continue;
    // CGAL takes the header's word for it, and knows no triangle strips.
    if (file.name == "binary_count_zero.stl" || file.name.find("strip") != std::string::npos) continue;
    try {
      core::read_polygon_soup(file.path);
    } catch (const core::BadInput&) {
      continue;
    }
    INFO(file.name);
    compared += check_against_cgal(file.path) ? 1 : 0;
  }
  CHECK(compared > 30);
}
