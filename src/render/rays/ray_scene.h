#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/scene.h"

namespace tera {

/// A ray leaving `origin_W_m` along the unit vector `direction_W` at a fraction `time` in [0, 1] of
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
  Eigen::Vector3f normal_W = Eigen::Vector3f::Zero();  ///< unit, towards the ray's origin
  float reflectance = 0;                               ///< of the surface, diffuse, 0..1
  float opacity = 1;    ///< of the surface's material; below 1 is glass
  bool leaves = false;  ///< met from behind: the ray comes out of what the surface encloses
  SemanticClass label = SemanticClass::kSky;
  std::uint16_t instance = 0;
};

/// Ray queries over the scene (Embree 3).
///
/// Model   bodies are instances with motion blur over an interval of time, so that every ray meets
///         the scene as it was at its own instant (straight lines between keys, as many keys as
///         keep what is 4 m from a body's origin within 0.05 mm of its arc); the terrain is one
///         geometry per tile, of which only tiles with a new version are rebuilt, and stands still
///         within an interval; the land around the site is that of the pictures.
/// Omits   transparency: glass is opaque with its own reflectance unless its opacity is 0. Ripples
///         of the terrain finer than its cells.
/// Source  soil darkening with moisture: a saturated soil reflects about half as much as a dry one
///         in the near infrared (after Lobell and Asner 2002), linear in saturation between.
class RayScene {
 public:
  /// Most poses that Update takes.
  static constexpr std::size_t kMaxPoses = 32;

  explicit RayScene(const SceneModel& model);
  ~RayScene();

  /// Sets the scene over [t0, t1]: `poses` at equally spaced times from t0 to t1 (1 to 32 of them),
  /// each with one pose for each body; the terrain and `shapes` as they are now.
  void Update(const std::vector<std::vector<Pose>>& poses, const TerrainSurface& terrain,
              const Shapes& shapes = {});

  /// First hit of each ray. Uses up to `threads` threads; the result does not depend on them.
  void Trace(std::span<const Ray> rays, std::span<RayHit> hits, int threads) const;

  /// Embree alone, on this thread and with nothing done about what is hit: the yardsticks for the
  /// speed of Trace. Ray by ray (rtcIntersect1), or in the packets that Trace takes
  /// (rtcIntersect8). Ranges are infinite where nothing is hit.
  void TraceBareSingly(std::span<const Ray> rays, std::span<float> range_m) const;
  void TraceBareInPackets(std::span<const Ray> rays, std::span<float> range_m) const;

  /// Memory that Embree holds now for meshes, ground and the trees over them.
  std::int64_t bytes() const;

  /// Terrain tiles built since the start; grows with dirty tiles only.
  std::int64_t tiles_rebuilt() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Version of the Embree library at run time, "3.13.5".
std::string EmbreeVersion();

}  // namespace tera
