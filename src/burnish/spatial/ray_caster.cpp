#include "burnish/spatial/ray_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

namespace burnish {

namespace {

/// Embree's copy of the mesh, alive as long as its scene.
struct Corners {
  const Vec3f* positions = nullptr;
  const Triangle* triangles = nullptr;

  /// The hit of a ray in double; `distance` stands where the ray lies in the triangle's plane.
  RayCaster::Hit hit(std::uint32_t triangle, const Vec3d& origin, const Vec3d& direction,
                     double distance) const {
    const auto [ia, ib, ic] = triangles[triangle];
    const Vec3d a(positions[ia]), b(positions[ib]), c(positions[ic]);
    const Vec3d normal = cross(b - a, c - a);
    const double slope = dot(normal, direction);
    if (slope != 0) distance = std::max(0.0, dot(normal, a - origin) / slope);
    const double area = squared_norm(normal);
    if (area == 0) return {triangle, distance, 0, 0};
    const Vec3d p = origin + distance * direction - a;
    return {triangle, distance, dot(cross(p, c - a), normal) / area,
            dot(cross(b - a, p), normal) / area};
  }
};

/// Copies `source` into a buffer that Embree allocates, with the padding that it reads beyond.
template <class T>
const T* copy_to_embree(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                        const std::vector<T>& source) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), source.size());
  if (!buffer) throw std::bad_alloc();
  std::memcpy(buffer, source.data(), source.size() * sizeof(T));
  return static_cast<const T*>(buffer);
}

/// Tells Embree whether to go on building.
bool goes_on(void* context, double) { return !static_cast<const Context*>(context)->cancelled(); }

RTCRayHit ray_to(double far, const Vec3d& origin, const Vec3d& direction) {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x);
  query.ray.org_y = static_cast<float>(origin.y);
  query.ray.org_z = static_cast<float>(origin.z);
  query.ray.dir_x = static_cast<float>(direction.x);
  query.ray.dir_y = static_cast<float>(direction.y);
  query.ray.dir_z = static_cast<float>(direction.z);
  query.ray.tfar = static_cast<float>(far);
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

/// An intersection context whose filter looks at every triangle on the ray and accepts none.
struct Collector {
  RTCIntersectContext context;  ///< first, because Embree hands back a pointer to it
  const Corners& corners;
  const Vec3d& origin;
  const Vec3d& direction;
  std::optional<RayCaster::Hit> nearest;

  static void filter(const RTCFilterFunctionNArguments* args) {
    auto& self = *reinterpret_cast<Collector*>(args->context);
    args->valid[0] = 0;
    const auto key = [](const RayCaster::Hit& h) { return std::pair(h.distance, h.triangle); };
    const auto hit = self.corners.hit(RTCHitN_primID(args->hit, 1, 0), self.origin, self.direction,
                                      RTCRayN_tfar(args->ray, 1, 0));
    if (!self.nearest || key(hit) < key(*self.nearest)) self.nearest = hit;
  }
};

/// So close to an edge, in barycentric coordinates, single precision may name either triangle.
constexpr double kNearEdge = 1e-3;
/// Relative error of a distance in single precision, with a wide margin.
constexpr double kDistanceSlack = 1e-5;

}  // namespace

struct RayCaster::Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Corners corners;

  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

RayCaster::RayCaster(const TriangleMesh& mesh, const Context& context)
    : scene_(std::make_unique<Scene>()) {
  if (mesh.triangles.empty()) return;
  scene_->device = rtcNewDevice(nullptr);
  if (!scene_->device) throw std::bad_alloc();
  scene_->scene = rtcNewScene(scene_->device);
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);

  RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  scene_->corners.positions =
      copy_to_embree(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.positions);
  scene_->corners.triangles =
      copy_to_embree(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneProgressMonitorFunction(scene_->scene, &goes_on, const_cast<Context*>(&context));
  rtcCommitScene(scene_->scene);
  rtcSetSceneProgressMonitorFunction(scene_->scene, nullptr, nullptr);
  if (context.cancelled()) {
    scene_ = std::make_unique<Scene>();
    return;
  }
  if (rtcGetDeviceError(scene_->device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

std::optional<RayCaster::Hit> RayCaster::cast(const Vec3d& origin,
                                              const Vec3d& unit_direction) const {
  if (!scene_->scene) return std::nullopt;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = ray_to(std::numeric_limits<double>::infinity(), origin, unit_direction);
  rtcIntersect1(scene_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const double found = query.ray.tfar;
  const Hit hit = scene_->corners.hit(query.hit.primID, origin, unit_direction, found);
  if (std::min({hit.u, hit.v, 1 - hit.u - hit.v}) > kNearEdge) return hit;

  // Near an edge the order of Embree's tree decides which triangle comes first, and that order may
  // change from build to build: look at all that lie there and choose by a rule of our own.
  Collector all{context, scene_->corners, origin, unit_direction, std::nullopt};
  all.context.filter = &Collector::filter;
  RTCRayHit again = ray_to(found * (1 + kDistanceSlack), origin, unit_direction);
  rtcIntersect1(scene_->scene, &all.context, &again);
  return all.nearest ? all.nearest : hit;
}

}  // namespace burnish
