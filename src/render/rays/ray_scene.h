#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/scene.h"

namespace tera {

/// A ray from `origin_W_m` along the unit vector `direction_W`. `time` in [0, 1] is the fraction of
/// the interval given to RayScene::Update.
struct Ray {
  Eigen::Vector3f origin_W_m;
  Eigen::Vector3f direction_W;
  float max_range_m = 100.0f;
  float time = 0.0f;
};

struct RayHit {
  bool hit = false;
  float range_m = 0;
  Eigen::Vector3f normal_W = Eigen::Vector3f::Zero();  ///< unit vector, towards the ray's origin
  float reflectance = 0;                               ///< diffuse reflectance of the surface, 0..1
  float opacity = 1;    ///< opacity of the surface's material; below 1: glass
  bool leaves = false;  ///< hit on the back face: the ray exits the enclosed volume
  SemanticClass label = SemanticClass::kSky;
  std::uint16_t instance = 0;
};

/// Ray queries over the scene (Embree 3).
///
/// Model   bodies are instances with motion blur over a time interval, so each ray meets the scene
///         at its own time. Motion is linear between keys; the keys keep a point 4 m from a body's
///         origin within 0.05 mm of its arc. The terrain has one geometry per tile and is static
///         within an interval; an update rebuilds only tiles with a new version. The surrounding
///         land equals the land of the images.
/// Omits   transparency: glass is opaque with its own reflectance, unless its opacity is 0. Terrain
///         ripples finer than its cells.
/// Source  soil darkening with moisture, linear in saturation: in the near infrared, a saturated
///         soil reflects about half as much as a dry soil (after Lobell and Asner 2002).
class RayScene {
 public:
  /// Maximum number of poses that Update accepts.
  static constexpr std::size_t kMaxPoses = 32;

  explicit RayScene(const SceneModel& model);
  ~RayScene();

  /// Sets the scene over [t0, t1]. `poses` holds 1 to 32 equally spaced times, each with one pose
  /// per body. The terrain and `shapes` are constant over the interval.
  void Update(const std::vector<std::vector<Pose>>& poses, const TerrainSurface& terrain,
              const Shapes& shapes = {});

  /// First hit of each ray. The result does not depend on the number of `threads`.
  void Trace(std::span<const Ray> rays, std::span<RayHit> hits, int threads) const;

  /// Embree queries alone, on the calling thread and without evaluation of hits: benchmarks for
  /// Trace. The first runs ray by ray (rtcIntersect1), the second in the packets of Trace
  /// (rtcIntersect8). A miss has infinite range.
  void TraceBareSingly(std::span<const Ray> rays, std::span<float> range_m) const;
  void TraceBareInPackets(std::span<const Ray> rays, std::span<float> range_m) const;

  /// Memory that Embree holds for meshes, ground and their trees.
  std::int64_t bytes() const;

  /// Number of terrain tiles built since construction; grows with dirty tiles only.
  std::int64_t tiles_rebuilt() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Version of the linked Embree library, "3.13.5".
std::string EmbreeVersion();

}  // namespace tera
