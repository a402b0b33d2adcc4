#include "mesh_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/mesh/welding.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/parameters.h"
#include "number.h"
#include "target.h"

namespace morsel::fuzz {
namespace {

using namespace core;

void check_soup(const LoadedSoup& loaded) {
  const PolygonSoup& soup = loaded.soup;
  require(!soup.offsets.empty() && soup.offsets.front() == 0 && soup.offsets.back() == soup.corners.size(),
          "ends of the offsets");
  require(std::is_sorted(soup.offsets.begin(), soup.offsets.end()), "order of the offsets");
  require(std::all_of(soup.corners.begin(), soup.corners.end(),
                      [&](Index v) { return v < soup.positions.size(); }),
          "a corner that is no vertex");
  for (const VertexProperty& property : loaded.properties) {
    require(!property.name.empty(), "a property without a name");
    require(property.values.size() == soup.positions.size(), "size of a property");
  }
  for (const VertexProperty& property : loaded.face_properties) {
    require(!property.name.empty(), "a property of faces without a name");
    require(property.values.size() == soup.polygon_count(), "size of a property of faces");
  }
  require(std::ranges::none_of(loaded.warnings, &std::string::empty), "a warning that says nothing");
}

bool same_positions(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Point& p, const Point& q) {
    return same_number(p.x(), q.x()) && same_number(p.y(), q.y()) && same_number(p.z(), q.z());
  });
}

bool same(const PolygonSoup& a, const PolygonSoup& b) {
  return a.offsets == b.offsets && a.corners == b.corners && same_positions(a.positions, b.positions);
}

/// The soup as the text of an OFF file.
std::string as_off(const PolygonSoup& soup) {
  std::string text =
      "OFF\n" + std::to_string(soup.positions.size()) + " " + std::to_string(soup.polygon_count()) + " 0\n";
  for (const Point& p : soup.positions) {
    for (int axis = 0; axis < 3; ++axis)
      text.append(axis == 0 ? "" : " ").append(std::isnan(p[axis]) ? "nan" : shortest(p[axis]));
    text += "\n";
  }
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    text += std::to_string(soup.polygon(f).size());
    for (const Index v : soup.polygon(f)) text += " " + std::to_string(v);
    text += "\n";
  }
  return text;
}

void check_mesh(const BuiltMesh& built) {
  const VertexNumbering& numbering = built.numbering;
  // validate() is slow, and small meshes suffice for it.
  if (built.mesh.triangle_count() < 1000) built.mesh.validate();
  require(numbering.to_input.empty() == numbering.from_input.empty(), "half a numbering");
  if (numbering.to_input.empty()) {
    require(numbering.input_count == built.mesh.vertex_count(), "no numbering though vertices changed");
    return;
  }
  require(numbering.to_input.size() == built.mesh.vertex_count(), "size of to_input");
  require(numbering.from_input.size() == numbering.input_count, "size of from_input");
  for (Index v = built.mesh.vertex_count(); v-- > 0;) {
    const Index input = numbering.to_input[v];
    require(input < numbering.input_count && numbering.from_input[input] <= v, "numbering");
    require(numbering.to_input[numbering.from_input[input]] == input, "numbering there and back");
  }
}

/// A mesh's own triangles are a soup that it is made of, with nothing to repair.
void check_again(const TriangleMesh& mesh) {
  PolygonSoup soup;
  soup.positions.assign(mesh.positions().begin(), mesh.positions().end());
  for (const Triangle& triangle : mesh.triangles()) soup.add_polygon(triangle);
  const BuiltMesh again = build_mesh(soup, {.repair = true});
  require(again.repairs.empty(), "a mesh that was repaired needs no repair");
  require(std::equal(mesh.triangles().begin(), mesh.triangles().end(), again.mesh.triangles().begin(),
                     again.mesh.triangles().end()),
          "a mesh of a mesh's triangles has the same");
}

struct Outcome {
  std::optional<LoadedSoup> soup;
  std::string error;
};

template <class Read>
Outcome outcome(const Read& read) {
  try {
    return {read(), {}};
  } catch (const BadInput& error) {
    return {{}, error.what()};
  }
}

}  // namespace

void check_mesh_format(std::string_view bytes, MeshFormat format) {
  const Outcome loaded = outcome([&] { return parse_polygon_soup(bytes, format, "fuzz"); });
  if (!loaded.soup) {
    require(!loaded.error.empty(), "an error says what is wrong");
    return;
  }
  const PolygonSoup& soup = loaded.soup->soup;
  check_soup(*loaded.soup);
  if (!soup.positions.empty() || soup.polygon_count() > 0)
    require(same(soup, parse_polygon_soup(as_off(soup), MeshFormat::off, "written").soup),
            "written and read again");
  for (const std::optional<Length>& weld :
       {std::optional<Length>(), std::optional(Length::absolute(0)), std::optional(Length::edges(0.5))})
    for (const bool repair : {false, true}) {
      try {
        const BuiltMesh built = build_mesh(soup, {repair, weld});
        check_mesh(built);
        require(repair || weld || built.repairs.empty(), "nothing is repaired unasked");
        check_again(built.mesh);
        if (weld && weld->value == 0 && !repair)
          require(count_unwelded(built.mesh, built.numbering) == 0, "what is welded needs no welding");
      } catch (const BadInput&) {
      }
    }
}

void check_pieces(std::string_view bytes,
                  const std::function<LoadedSoup(std::string_view bytes, std::size_t chunk)>& read) {
  static const ThreadLimit kTwo(2);  // one alone would not read in pieces
  const Outcome whole = outcome([&] { return read(bytes, std::numeric_limits<std::size_t>::max()); });
  for (const std::size_t chunk : {std::size_t{1}, std::size_t{24}, std::size_t{200}}) {
    const Outcome pieces = outcome([&] { return read(bytes, chunk); });
    require(whole.error == pieces.error, "the same error in pieces");
    require(whole.soup.has_value() == pieces.soup.has_value() &&
                (!whole.soup || (same(whole.soup->soup, pieces.soup->soup) &&
                                 whole.soup->warnings == pieces.soup->warnings)),
            "the same soup in pieces");
  }
}

}  // namespace morsel::fuzz
