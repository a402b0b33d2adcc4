#include "morsel/tools/render/body.h"

#include <Eigen/Geometry>
#include <utility>

#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::tools::render {

Body make_body(const core::TriangleMesh& mesh) {
  const core::TriangleMesh unit = morse::unit_sized(mesh).mesh;  // so that no difference overflows below
  const core::BoundingBox& box = unit.bounding_box();
  const core::Point center = (box.min + box.max) / 2;
  const double scale = box.diagonal() > 0 ? 1 / box.diagonal() : 1;
  std::vector<core::Point> positions(unit.positions().begin(), unit.positions().end());
  for (core::Point& p : positions) p = (p - center) * scale;
  core::TriangleMesh body = mesh.with_positions(std::move(positions));
  std::vector<core::Point> normals = morse::vertex_normals(body);
  double area = 0;
  for (const core::Triangle& t : body.triangles()) {
    const core::Point& a = body.position(t[0]);
    area += (body.position(t[1]) - a).cross(body.position(t[2]) - a).norm() / 2;
  }
  return {std::move(body), std::move(normals), area};
}

}  // namespace morsel::tools::render
