#include "morsel/tools/render/rays.h"

#include <embree3/rtcore.h>

#include <new>

#include "morsel/core/parallel/parallel.h"

namespace morsel::tools::render {
namespace {

/// Room for `count` items of a geometry's buffer, owned and padded by Embree.
template <class Item>
Item* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  void* memory = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), count);
  if (memory == nullptr) throw std::bad_alloc();
  return static_cast<Item*>(memory);
}

struct Float3 {
  float x, y, z;
};
struct Float4 {
  float x, y, z, radius;
};

}  // namespace

struct Rays::Scene {
  // Without its cache for subdivision surfaces, of which there are none here: 128 MiB of address space.
  RTCDevice device = rtcNewDevice("tessellation_cache_size=0");
  RTCScene scene = nullptr;

  Scene() {
    if (device == nullptr) throw std::bad_alloc();
    scene = rtcNewScene(device);
    if (scene == nullptr) {
      rtcReleaseDevice(device);
      throw std::bad_alloc();
    }
    // Rays must not pass between neighbouring triangles.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  }
  ~Scene() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  RTCGeometry begin(RTCGeometryType type) {
    RTCGeometry geometry = rtcNewGeometry(device, type);
    if (geometry == nullptr) throw std::bad_alloc();
    return geometry;
  }
  /// Geometries are numbered by their kind.
  void attach(RTCGeometry geometry, Hit::Kind kind) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(kind));
    rtcReleaseGeometry(geometry);
  }
};

Rays::Rays(const core::TriangleMesh& mesh, std::span<const Ball> balls, std::span<const Capsule> capsules)
    : scene_(std::make_unique<Scene>()) {
  {
    RTCGeometry geometry = scene_->begin(RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = buffer<Float3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertex_count());
    for (const core::Point& p : mesh.positions())
      *points++ = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    auto* corners =
        buffer<core::Triangle>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangle_count());
    for (const core::Triangle& t : mesh.triangles()) *corners++ = t;
    scene_->attach(geometry, Hit::Kind::triangle);
  }
  if (!balls.empty()) {
    RTCGeometry geometry = scene_->begin(RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* points = buffer<Float4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, balls.size());
    for (const Ball& b : balls) *points++ = {b.center[0], b.center[1], b.center[2], b.radius};
    scene_->attach(geometry, Hit::Kind::sphere);
  }
  if (!capsules.empty()) {
    RTCGeometry geometry = scene_->begin(RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    auto* points = buffer<Float4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 2 * capsules.size());
    auto* starts = buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, capsules.size());
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      const Capsule& c = capsules[i];
      *points++ = {c.a[0], c.a[1], c.a[2], c.radius};
      *points++ = {c.b[0], c.b[1], c.b[2], c.radius};
      starts[i] = static_cast<std::uint32_t>(2 * i);
    }
    scene_->attach(geometry, Hit::Kind::capsule);
  }
  {
    // Among equally near intersections the order of the tree decides, which would depend on the threads.
    const core::ThreadLimit one(1);
    rtcCommitScene(scene_->scene);
  }
  if (rtcGetDeviceError(scene_->device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

Rays::~Rays() = default;
Rays::Rays(Rays&&) noexcept = default;
Rays& Rays::operator=(Rays&&) noexcept = default;

bool Rays::first(const Vec3& origin, const Vec3& direction, float near, float far, Hit& hit) const {
  RTCRayHit query{};
  query.ray.org_x = origin[0];
  query.ray.org_y = origin[1];
  query.ray.org_z = origin[2];
  query.ray.tnear = near;
  query.ray.dir_x = direction[0];
  query.ray.dir_y = direction[1];
  query.ray.dir_z = direction[2];
  query.ray.tfar = far;
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.kind = static_cast<Hit::Kind>(query.hit.geomID);
  hit.item = query.hit.primID;
  hit.distance = query.ray.tfar;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  hit.normal = Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized();
  return true;
}

bool Rays::any(const Vec3& origin, const Vec3& direction, float near, float far) const {
  RTCRay ray{};
  ray.org_x = origin[0];
  ray.org_y = origin[1];
  ray.org_z = origin[2];
  ray.tnear = near;
  ray.dir_x = direction[0];
  ray.dir_y = direction[1];
  ray.dir_z = direction[2];
  ray.tfar = far;
  ray.mask = ~0u;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->scene, &context, &ray);
  return ray.tfar < 0;  // Embree's mark of a hit
}

}  // namespace morsel::tools::render
