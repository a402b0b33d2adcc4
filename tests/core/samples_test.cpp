// Every sample mesh loads or is refused with one clear sentence.

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;

TEST_CASE("every sample mesh loads or is refused with a sentence and so after repair") {
  // What is wrong with those that are refused, without and with repair.
  const std::map<std::string, std::pair<std::string, std::string>> refused = {
      {"b9.ply", {"no triangle and 22300 vertices that no face uses", "no triangle"}},
      {"blobby-shuffled.off", {"3069 edges between faces of opposite orientation", ""}},
      {"cube-ouvert.off", {"1 vertex that no face uses (8)", ""}},
      {"cube-shuffled.off", {"9 edges between faces of opposite orientation", ""}},
      {"cube4-shuffled.off", {"4 edges between faces of opposite orientation", ""}},
      {"oblong-shuffled.off", {"623 edges between faces of opposite orientation", ""}},
      {"pig.stl", {"421 non-manifold vertices", ""}},
      {"polygon_mesh.off", {"2 non-manifold vertices (4113, 4349)", ""}},
      {"prim.off", {"3 vertices that no face uses (8, 9, 10)", ""}},  // its header leaves out a face
      {"tet-shuffled.off", {"4 edges between faces of opposite orientation", ""}},
  };
  const std::filesystem::path folder = std::filesystem::path(sample("lion-head.off")).parent_path();
  std::size_t loaded = 0, seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.file_size() > 5'000'000) continue;
    const std::string name = entry.path().filename().string();
    ++seen;
    const auto known = refused.find(name);
    std::optional<core::LoadedSoup> file;
    std::string unreadable;
    try {
      file = core::read_polygon_soup(entry.path());
    } catch (const core::BadInput& error) {
      unreadable = error.what();
      CHECK(unreadable.find(name) != std::string::npos);
    }
    for (const bool repair : {false, true}) {
      INFO(name << (repair ? " with repair" : ""));
      std::string expected;
      if (known != refused.end()) expected = repair ? known->second.second : known->second.first;
      std::string message = unreadable;
      try {
        if (file) {
          const core::TriangleMesh mesh = core::build_mesh(file->soup, {.repair = repair}).mesh;
          if (mesh.vertex_count() < 1000) mesh.validate();
          ++loaded;
        }
      } catch (const core::MeshError& error) {
        message = error.what();
      }
      CHECK(message.empty() == expected.empty());
      CHECK(message.find(expected) != std::string::npos);
    }
  }
  CHECK(seen > 100);
  CHECK(loaded > 200);
}

TEST_CASE("the reference meshes have their known topology") {
  const core::TriangleMesh lion = core::read_mesh(sample("lion-head.off")).mesh;
  CHECK(lion.vertex_count() == 8356);
  CHECK(lion.euler_characteristic() == 1);
  CHECK(lion.boundary_loop_count() == 1);
  CHECK(lion.bounding_box().diagonal() == Approx(1.57).epsilon(0.01));
  const core::TriangleMesh bunny = core::read_mesh(sample("bunny00.off")).mesh;
  CHECK(bunny.vertex_count() == 37706);
  CHECK(bunny.is_closed());
}
