#include "render/rays/ray_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <utility>

#include "core/check.h"
#include "render/rays/body_shape.h"
#include "render/rays/embree_watch.h"
#include "render/rays/motion_keys.h"
#include "render/rays/ray_terrain.h"
#include "render/rays/threads.h"

namespace tera {
namespace {

/// Rays that a thread takes at a time.
constexpr std::size_t kRaysPerBlock = 1024;
/// Rays per Embree packet. It divides kRaysPerBlock, so that the packets do not depend on the
/// number of threads.
constexpr std::size_t kPacket = 8;
constexpr unsigned kAllGeometry = 0xffffffffu;

RTCRayHit QueryFor(const Ray& ray) {
  RTCRayHit query;
  query.ray.org_x = ray.origin_W_m.x();
  query.ray.org_y = ray.origin_W_m.y();
  query.ray.org_z = ray.origin_W_m.z();
  query.ray.dir_x = ray.direction_W.x();
  query.ray.dir_y = ray.direction_W.y();
  query.ray.dir_z = ray.direction_W.z();
  query.ray.tnear = 0.0f;
  query.ray.tfar = ray.max_range_m;
  query.ray.time = ray.time;
  query.ray.mask = kAllGeometry;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

struct RayScene::Impl {
  struct Body {
    int shape = -1;
    std::vector<int> nodes;  ///< indices into the model's nodes
    EmbreeGeometry geometry;
    std::vector<Pose> keys;
    int changing = -1;  ///< index of its deforming shape; -1: none
    std::shared_ptr<const ShapedMesh> shown;
  };
  explicit Impl(const SceneModel& scene_model);
  void FindShapes();
  void AddInstance(std::size_t index);
  void UpdateBody(std::size_t index, std::vector<Pose> keys);
  void UpdateShape(Body* body, const Shapes& now);
  /// Traces up to kPacket rays of similar origin and direction as one packet.
  RTCRayHit8 Intersect(std::span<const Ray> rays, RTCIntersectContext* context) const;
  void TracePacket(std::span<const Ray> rays, RTCIntersectContext* context, RayHit* hits) const;
  void Describe(const Ray& ray, const RTCHit& found, RayHit* hit) const;

  const SceneModel model;
  EmbreeErrors errors;
  EmbreeMemory held;
  EmbreeDevice device;
  EmbreeScene scene;
  std::vector<BodyShape> shapes;
  std::vector<Body> bodies;
  std::vector<int> body_of;  ///< body index by geometry id of the whole scene, for instances
  std::unique_ptr<RayTerrain> ground;
};

RayScene::Impl::Impl(const SceneModel& scene_model)
    : model(scene_model), device(rtcNewDevice("threads=1")) {
  TERA_CHECK(device.get() != nullptr);
  errors.Watch(device.get());
  held.Watch(device.get());
  scene = EmbreeScene(rtcNewScene(device.get()));
  // Low quality selects Embree's two-level build: one tree per tile, which is kept until the tile
  // changes. Updates take far less time than with a single tree, and queries are as fast.
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
  rtcSetSceneFlags(scene.get(),
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
  bodies.resize(model.body_count);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    bodies.at(model.nodes[n].body).nodes.push_back(static_cast<int>(n));
  }
  FindShapes();
  for (std::size_t b = 0; b < bodies.size(); ++b) AddInstance(b);
  ground = std::make_unique<RayTerrain>(device.get(), scene.get(), model);
  rtcCommitScene(scene.get());
  errors.Check();
}

/// Groups the nodes by body. Bodies with identical meshes share a shape, unless they deform.
void RayScene::Impl::FindShapes() {
  for (Body& body : bodies) {
    if (body.nodes.empty()) continue;
    BodyShape shape;
    body.changing = model.nodes[body.nodes.front()].shape;
    if (body.changing >= 0) {
      TERA_CHECK(body.nodes.size() == 1, body.nodes.size());
      body.shape = static_cast<int>(shapes.size());
      shapes.push_back(std::move(shape));
      continue;
    }
    for (const int n : body.nodes) {
      shape.meshes.push_back(model.nodes[n].mesh);
      shape.labels.push_back(model.nodes[n].label);
      shape.X_BG.push_back(model.nodes[n].X_BG);
      shape.scale.push_back(model.nodes[n].scale);
    }
    const auto same = std::find_if(shapes.begin(), shapes.end(), [&](const BodyShape& s) {
      return !s.meshes.empty() && s.Alike(shape);
    });
    body.shape = static_cast<int>(same - shapes.begin());
    if (same != shapes.end()) continue;
    shape.scene = NewScene(device.get());
    for (std::size_t i = 0; i < shape.meshes.size(); ++i) {
      AttachParts(device.get(), model.meshes.at(shape.meshes[i]).parts, static_cast<int>(i),
                  model.environment.weather.rain_mmph > 0, &shape);
    }
    rtcCommitScene(shape.scene.get());
    shapes.push_back(std::move(shape));
  }
}

void RayScene::Impl::AddInstance(std::size_t index) {
  Body& body = bodies[index];
  if (body.nodes.empty()) return;
  if (body.changing < 0 && shapes[body.shape].parts.empty()) return;
  body.geometry = EmbreeGeometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
  if (body.changing < 0) {
    rtcSetGeometryInstancedScene(body.geometry.get(), shapes[body.shape].scene.get());
  }
  rtcDisableGeometry(body.geometry.get());
  rtcCommitGeometry(body.geometry.get());
  const unsigned id = rtcAttachGeometry(scene.get(), body.geometry.get());
  body_of.resize(std::max<std::size_t>(body_of.size(), id + 1), -1);
  body_of[id] = static_cast<int>(index);
}

/// Rebuilds the mesh of a deforming body if it has changed. The caller must then call UpdateBody.
void RayScene::Impl::UpdateShape(Body* body, const Shapes& now) {
  const ShapedMesh* mesh = ShapeAt(now, body->changing);
  if (AreAlike(mesh, body->shown.get())) return;
  body->keys.clear();
  if (mesh == nullptr) {
    body->shown.reset();
    return;
  }
  body->shown = now[body->changing];
  const SceneNode& node = model.nodes[body->nodes.front()];
  BodyShape shape;
  shape.labels = {node.label};
  shape.X_BG = {node.X_BG};
  shape.scale = {node.scale};
  shape.scene = NewScene(device.get());
  AttachParts(device.get(), mesh->parts, 0, false, &shape);  // carried soil has its own moisture
  rtcCommitScene(shape.scene.get());
  rtcSetGeometryInstancedScene(body->geometry.get(), shape.scene.get());
  shapes[body->shape] = std::move(shape);
}

void RayScene::Impl::UpdateBody(std::size_t index, std::vector<Pose> keys) {
  Body& body = bodies[index];
  if (body.geometry.get() == nullptr) return;
  const bool is_hidden = body.changing >= 0 && body.shown == nullptr;
  if (is_hidden) {
    rtcDisableGeometry(body.geometry.get());
    return;
  }
  bool same = body.keys.size() == keys.size();
  for (std::size_t k = 0; same && k < keys.size(); ++k) {
    same = keys[k].matrix() == body.keys[k].matrix();
  }
  if (same) return;
  body.keys = std::move(keys);
  RTCGeometry geometry = body.geometry.get();
  rtcEnableGeometry(geometry);
  rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(body.keys.size()));
  for (std::size_t k = 0; k < body.keys.size(); ++k) {
    Eigen::Matrix<float, 3, 4> X_WB = body.keys[k].matrix().topRows<3>().cast<float>();
    rtcSetGeometryTransform(geometry, static_cast<unsigned>(k), RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            X_WB.data());
  }
  rtcCommitGeometry(geometry);
}

RTCRayHit8 RayScene::Impl::Intersect(std::span<const Ray> rays,
                                     RTCIntersectContext* context) const {
  RTCRayHit8 packet;
  alignas(32) int valid[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) {
    valid[i] = i < rays.size() ? -1 : 0;
    const Ray& ray = rays[std::min(i, rays.size() - 1)];
    packet.ray.org_x[i] = ray.origin_W_m.x();
    packet.ray.org_y[i] = ray.origin_W_m.y();
    packet.ray.org_z[i] = ray.origin_W_m.z();
    packet.ray.dir_x[i] = ray.direction_W.x();
    packet.ray.dir_y[i] = ray.direction_W.y();
    packet.ray.dir_z[i] = ray.direction_W.z();
    packet.ray.tnear[i] = 0.0f;
    packet.ray.tfar[i] = ray.max_range_m;
    packet.ray.time[i] = ray.time;
    packet.ray.mask[i] = kAllGeometry;
    packet.ray.id[i] = 0;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect8(valid, scene.get(), context, &packet);
  return packet;
}

void RayScene::Impl::TracePacket(std::span<const Ray> rays, RTCIntersectContext* context,
                                 RayHit* hits) const {
  RTCRayHit8 packet = Intersect(rays, context);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits[i] = RayHit();
    if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    hits[i].hit = true;
    hits[i].range_m = packet.ray.tfar[i];
    Describe(rays[i],
             rtcGetHitFromHitN(reinterpret_cast<RTCHitN*>(&packet.hit), kPacket,
                               static_cast<unsigned>(i)),
             &hits[i]);
  }
}

void RayScene::Impl::Describe(const Ray& ray, const RTCHit& found, RayHit* hit) const {
  Eigen::Vector3f normal(found.Ng_x, found.Ng_y, found.Ng_z);
  if (found.instID[0] == RTC_INVALID_GEOMETRY_ID) {
    hit->reflectance = ground->ReflectanceAt(found.geomID, found.primID);
    hit->label = SemanticClass::kTerrain;
    hit->instance = 0;
  } else {
    const Body& body = bodies[body_of[found.instID[0]]];
    const BodyShape::Part& part = shapes[body.shape].parts[found.geomID];
    const SceneNode& node = model.nodes[body.nodes[part.node]];
    Eigen::Matrix<float, 3, 4> X_WB;
    rtcGetGeometryTransform(body.geometry.get(), ray.time, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            X_WB.data());
    normal = X_WB.leftCols<3>() * normal;
    hit->reflectance = part.reflectance;
    hit->opacity = part.opacity;
    hit->label = node.label;
    hit->instance = node.instance;
  }
  normal.normalize();
  hit->leaves = normal.dot(ray.direction_W) > 0;
  hit->normal_W = hit->leaves ? Eigen::Vector3f(-normal) : normal;
}

RayScene::RayScene(const SceneModel& model) : impl_(std::make_unique<Impl>(model)) {}
RayScene::~RayScene() = default;

void RayScene::Update(const std::vector<std::vector<Pose>>& poses, const TerrainSurface& terrain,
                      const Shapes& shapes) {
  TERA_CHECK(!poses.empty() && poses.size() <= kMaxPoses, poses.size());
  for (const std::vector<Pose>& at : poses)
    TERA_CHECK(at.size() == impl_->bodies.size(), at.size());
  for (std::size_t b = 0; b < impl_->bodies.size(); ++b) {
    if (impl_->bodies[b].changing >= 0) impl_->UpdateShape(&impl_->bodies[b], shapes);
    impl_->UpdateBody(b, MotionKeys(poses, b));
  }
  impl_->ground->Update(terrain);
  rtcCommitScene(impl_->scene.get());
  impl_->errors.Check();
}

void RayScene::Trace(std::span<const Ray> rays, std::span<RayHit> hits, int threads) const {
  TERA_CHECK(rays.size() == hits.size(), rays.size(), hits.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (;;) {
      const std::size_t begin = next.fetch_add(kRaysPerBlock);
      if (begin >= rays.size()) return;
      const std::size_t end = std::min(begin + kRaysPerBlock, rays.size());
      for (std::size_t i = begin; i < end; i += kPacket) {
        const std::size_t count = std::min(kPacket, end - i);
        impl_->TracePacket(rays.subspan(i, count), &context, &hits[i]);
      }
    }
  };
  const std::size_t blocks = (rays.size() + kRaysPerBlock - 1) / kRaysPerBlock;
  RunOnThreads(static_cast<int>(std::min<std::size_t>(std::max(threads, 1), blocks)), work);
  impl_->errors.Check();
}

void RayScene::TraceBareSingly(std::span<const Ray> rays, std::span<float> range_m) const {
  TERA_CHECK(rays.size() == range_m.size(), rays.size(), range_m.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRayHit query = QueryFor(rays[i]);
    rtcIntersect1(impl_->scene.get(), &context, &query);
    const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    range_m[i] = hit ? query.ray.tfar : std::numeric_limits<float>::infinity();
  }
}

void RayScene::TraceBareInPackets(std::span<const Ray> rays, std::span<float> range_m) const {
  TERA_CHECK(rays.size() == range_m.size(), rays.size(), range_m.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t begin = 0; begin < rays.size(); begin += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - begin);
    const RTCRayHit8 packet = impl_->Intersect(rays.subspan(begin, count), &context);
    for (std::size_t i = 0; i < count; ++i) {
      const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      range_m[begin + i] = hit ? packet.ray.tfar[i] : std::numeric_limits<float>::infinity();
    }
  }
}

std::int64_t RayScene::bytes() const { return impl_->held.bytes(); }

std::int64_t RayScene::tiles_rebuilt() const { return impl_->ground->tiles_rebuilt(); }

std::string EmbreeVersion() {
  RTCDevice device = rtcNewDevice(nullptr);
  const auto part = [&](RTCDeviceProperty property) {
    return rtcGetDeviceProperty(device, property);
  };
  const std::string version =
      fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                  part(RTC_DEVICE_PROPERTY_VERSION_MINOR), part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
  rtcReleaseDevice(device);
  return version;
}

}  // namespace tera
