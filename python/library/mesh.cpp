/// Meshes: from arrays and files, as arrays, and to files.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/mesh/mesh_defects.h"
#include "morsel/core/mesh/subdivision.h"
#include "morsel/core/mesh/welding.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/request.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"

namespace morsel::python {
namespace {

using core::Index;
using core::TriangleMesh;

MeshHandle handle_of(core::BuiltMesh built, const core::BuildOptions& build, const core::Progress& progress) {
  if (std::string text = core::unwelded_warning(built.mesh, built.numbering, progress); !text.empty())
    built.warnings.push_back(std::move(text));
  return std::make_shared<MeshData>(
      MeshData{{std::move(built.mesh),
                {std::move(built.numbering), {}, std::move(built.repairs), std::move(built.warnings)}},
               {},
               build});
}

using Text = std::optional<std::string>;

/// Vertices that a mask leaves out: those where it is 0, False or nan; empty without a mask.
std::vector<bool> left_out_by(const py::object& mask) {
  std::vector<bool> left_out;
  if (mask.is_none()) return left_out;
  for (const double value : values_from(mask.cast<py::array>(), "the mask"))
    left_out.push_back(value == 0 || std::isnan(value));
  return left_out;
}

/// Triangles that are a mesh as they are: with less memory than polygons.
MeshHandle from_triangles(const py::array& positions, const py::array& faces, const py::object& report) {
  std::vector<core::Point> points = points_from(positions, "the vertices");
  std::vector<core::Triangle> triangles = triangles_from(faces);
  return compute(report, [&](const core::Progress& progress) {
    const std::size_t count = points.size();
    progress.update("building the mesh", 0);
    MeshHandle mesh =
        handle_of({TriangleMesh(std::move(points), std::move(triangles)), {count, {}, {}}, {}}, {}, progress);
    progress.update("building the mesh", 1);
    return mesh;
  });
}

/// From arrays of vertices (n, 3) and faces (m, k).
MeshHandle from_arrays(const py::array& positions, const py::array& faces, bool repair, const Text& weld,
                       const py::object& mask, const py::object& report) {
  const bool are_triangles = faces.ndim() == 2 && faces.shape(1) == 3;
  if (are_triangles && !repair && !weld && mask.is_none()) return from_triangles(positions, faces, report);
  const core::BuildOptions build = build_options({repair, weld});
  const std::vector<bool> left_out = left_out_by(mask);
  core::PolygonSoup soup = soup_from(positions, faces);
  return compute(report, [&](const core::Progress& progress) {
    return handle_of(core::build_mesh(std::move(soup), build, progress, left_out), build, progress);
  });
}

/// From polygons of several sizes: face i has the corners from offsets[i] on.
MeshHandle from_polygons(const py::array& positions, const py::array& corners, const py::array& offsets,
                         bool repair, const Text& weld, const py::object& mask, const py::object& report) {
  const core::BuildOptions build = build_options({repair, weld});
  const std::vector<bool> left_out = left_out_by(mask);
  core::PolygonSoup soup;
  soup.positions = points_from(positions, "the vertices");
  soup.corners = indices_from(corners, "the corners of the faces");
  const std::vector<Index> places = indices_from(offsets, "the offsets of the faces");
  soup.offsets.assign(places.begin(), places.end());
  const bool fits = !places.empty() && places.front() == 0 && places.back() == soup.corners.size() &&
                    std::ranges::is_sorted(places);
  if (!fits) throw py::value_error("the offsets of the faces must ascend from 0 to the number of corners");
  return compute(report, [&](const core::Progress& progress) {
    return handle_of(core::build_mesh(std::move(soup), build, progress, left_out), build, progress);
  });
}

MeshHandle read(const std::string& path, bool repair, const Text& weld, const Text& mask,
                const py::object& report) {
  const core::BuildOptions build = build_options({repair, weld, mask});
  return compute(report, [&](const core::Progress& progress) {
    std::error_code error;  // of which reading has more to tell
    const std::filesystem::file_time_type time = last_change(path, error);
    return std::make_shared<MeshData>(MeshData{core::read_mesh(path, build, progress), path, build, time,
                                               std::filesystem::absolute(path).string()});
  });
}

py::list defects_of(const py::array& positions, const py::array& faces) {
  core::PolygonSoup soup = soup_from(positions, faces);
  const auto found = compute(py::none(), [&](const core::Progress& progress) {
    try {
      core::build_mesh(std::move(soup), {}, progress);
    } catch (const core::MeshError& error) {
      return error.defects();
    }
    return std::vector<core::Defect>();
  });
  return defects(found);
}

/// Writes .off or .ply; `properties` are (name, values) of vertices.
void save(const MeshHandle& mesh, const std::string& path, const py::list& properties,
          const py::object& report) {
  std::vector<core::VertexProperty> named;
  for (const py::handle& one : properties) {
    const auto property = one.cast<py::tuple>();
    named.push_back(
        {property[0].cast<std::string>(), values_from(property[1].cast<py::array>(), "a property")});
  }
  const std::string extension = core::file_extension(path);
  if (extension != ".off" && extension != ".ply")
    throw core::InvalidArgument("a mesh is written to .off or .ply, not to " + path);
  if (extension == ".off" && !named.empty())
    throw core::InvalidArgument("an .off file holds no properties of vertices; write a .ply file");
  std::error_code error;  // of paths that are not there
  if (!mesh->path.empty() && std::filesystem::equivalent(path, mesh->file, error))
    throw core::InvalidArgument(path + " is the file that the mesh was read from; give another name");
  run_job(report, [&](const core::Progress& progress) {
    if (extension == ".off")
      core::write_off(path, mesh->mesh(), {}, progress);
    else
      core::write_ply(path, mesh->mesh(), named, {}, progress);
  });
}

py::array faces(const MeshHandle& mesh) { return rows_of<Index, 3>(mesh->mesh().triangles(), mesh); }

py::array edges(const MeshHandle& mesh) {
  std::vector<std::array<Index, 2>> all(mesh->mesh().edge_count());
  for (Index e = 0; e < all.size(); ++e) {
    all[e] = mesh->mesh().edge_vertices(e);  // in the direction of a half-edge
    std::ranges::sort(all[e]);
  }
  const auto kept = std::make_shared<const std::vector<std::array<Index, 2>>>(std::move(all));
  return rows_of<Index, 2>(std::span<const std::array<Index, 2>>(*kept), kept);
}

py::array vertex_normals(const MeshHandle& mesh) {
  const auto kept = compute(py::none(), [&](const core::Progress&) {
    return std::make_shared<const std::vector<core::Point>>(
        morse::vertex_normals(morse::unit_sized(mesh->mesh()).mesh));
  });
  return rows_of(std::span<const core::Point>(*kept), kept);
}

py::list boundary_loops(const MeshHandle& mesh) {
  py::list loops;
  for (Index k = 0; k < mesh->mesh().boundary_loop_count(); ++k) {
    std::vector<Index> vertices;
    for (const Index h : mesh->mesh().boundary_loop(k)) vertices.push_back(mesh->mesh().origin(h));
    loops.append(taken(std::move(vertices)));
  }
  return loops;
}

py::array components(const MeshHandle& mesh) {
  std::vector<Index> of_vertex(mesh->mesh().vertex_count());
  for (Index v = 0; v < of_vertex.size(); ++v) of_vertex[v] = mesh->mesh().component_of_vertex(v);
  return taken(std::move(of_vertex));
}

/// Per vertex its number in the input.
py::array input_vertices(const MeshHandle& mesh) {
  std::vector<Index> numbers(mesh->mesh().vertex_count());
  for (Index v = 0; v < numbers.size(); ++v) numbers[v] = mesh->loaded.source.numbering.input_vertex(v);
  return taken(std::move(numbers));
}

py::dict properties(const MeshHandle& mesh) {
  py::dict result;
  for (const core::VertexProperty& property : mesh->loaded.source.properties)
    result[text(property.name)] = view_of(std::span<const double>(property.values), mesh);
  return result;
}

/// The same triangles with other positions.
MeshHandle with_positions(const MeshHandle& mesh, const py::array& positions) {
  std::vector<core::Point> points = points_from(positions, "the vertices");
  const core::MeshSource& source = mesh->loaded.source;
  return compute(py::none(), [&](const core::Progress&) {
    return std::make_shared<MeshData>(
        MeshData{{mesh->mesh().with_positions(std::move(points)), source}, {}, mesh->build});
  });
}

MeshHandle subdivided(const MeshHandle& mesh, int pieces) {
  return compute(py::none(), [&](const core::Progress&) {
    TriangleMesh fine = core::subdivided(mesh->mesh(), pieces);
    const std::size_t count = fine.vertex_count();
    return std::make_shared<MeshData>(MeshData{{std::move(fine), {{count, {}, {}}, {}, {}}}, {}, {}});
  });
}

void add_counts(py::class_<MeshData, MeshHandle>& type) {
  const auto number = [&](const char* name, auto get) {
    type.def_property_readonly(name, [get](const MeshData& mesh) { return get(mesh.mesh()); });
  };
  number("vertex_count", [](const TriangleMesh& m) { return m.vertex_count(); });
  number("edge_count", [](const TriangleMesh& m) { return m.edge_count(); });
  number("face_count", [](const TriangleMesh& m) { return m.triangle_count(); });
  number("component_count", [](const TriangleMesh& m) { return m.component_count(); });
  number("boundary_loop_count", [](const TriangleMesh& m) { return m.boundary_loop_count(); });
  number("euler_characteristic", [](const TriangleMesh& m) { return m.euler_characteristic(); });
  number("genus", [](const TriangleMesh& m) { return m.genus(); });
  number("epsilon", [](const TriangleMesh& m) { return m.epsilon(); });
  number("diagonal", [](const TriangleMesh& m) { return m.bounding_box().diagonal(); });
}

}  // namespace

void add_mesh(py::module_& m) {
  py::class_<MeshData, MeshHandle> type(m, "Mesh");
  add_counts(type);
  type.def_property_readonly("positions",
                             [](const MeshHandle& mesh) { return rows_of(mesh->mesh().positions(), mesh); })
      .def_property_readonly("faces", &faces)
      .def_property_readonly("path", [](const MeshData& mesh) { return py::bytes(mesh.path); })
      .def_property_readonly("repair", [](const MeshData& mesh) { return mesh.build.repair; })
      .def_property_readonly("warnings",
                             [](const MeshData& mesh) { return texts(mesh.loaded.source.warnings); })
      .def_property_readonly("input_count",
                             [](const MeshData& mesh) { return mesh.loaded.source.numbering.input_count; })
      .def_property_readonly(
          "is_renumbered",
          [](const MeshData& mesh) { return !mesh.loaded.source.numbering.to_input.empty(); })
      .def_property_readonly("repairs",
                             [](const MeshData& mesh) {
                               py::dict result;
                               for (const core::Repair& repair : mesh.loaded.source.repairs)
                                 result[text(repair.action)] = repair.count;
                               return result;
                             })
      .def("is_same", [](const MeshData& a, const MeshData& b) { return a.mesh().is_same(b.mesh()); })
      .def("edges", &edges)
      .def("vertex_normals", &vertex_normals)
      .def("boundary_loops", &boundary_loops)
      .def("components", &components)
      .def("input_vertices", &input_vertices)
      .def("properties", &properties)
      .def("with_positions", &with_positions)
      .def("subdivided", &subdivided)
      .def("length",
           [](const MeshData& mesh, const std::string& length) {
             const py::gil_scoped_release without_lock;
             return core::parse_length(length, "the length").on(mesh.mesh());
           })
      .def("save", &save);
  m.def("mesh_from_arrays", &from_arrays);
  m.def("mesh_from_polygons", &from_polygons);
  m.def("read_mesh", &read);
  m.def("defects", &defects_of);
}

}  // namespace morsel::python
