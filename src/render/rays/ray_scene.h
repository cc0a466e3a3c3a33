#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/scene.h"

namespace tera {

/// A ray from `origin_W_m` along the unit vector `direction_W`. `time` in [0, 1] is its time within
/// the interval of RayScene::Update.
struct Ray {
  Eigen::Vector3f origin_W_m;
  Eigen::Vector3f direction_W;
  float max_range_m = 100.0f;
  float time = 0.0f;
};

struct RayHit {
  bool hit = false;
  float range_m = 0;
  /// Unit normal of the surface; it points to the side from which the ray comes.
  Eigen::Vector3f normal_W = Eigen::Vector3f::Zero();
  float reflectance = 0;  ///< diffuse reflectance of the surface, 0..1
  float opacity = 1;      ///< opacity of the surface's material; below 1: glass
  bool leaves = false;    ///< hit from behind: the ray leaves the enclosed volume
  SemanticClass label = SemanticClass::kSky;
  std::uint16_t instance = 0;
};

/// Ray queries over the scene (Embree 3).
///
/// Model   bodies are Embree instances with motion blur over a time interval, so each ray meets the
///         scene at its own time. Motion is linear between keys (motion_keys.h). The terrain does
///         not change within an interval. It has one geometry per tile; an update rebuilds only
///         tiles with a new version. The surrounding land is that of the images.
/// Omits   transparency: glass is opaque with its own reflectance, unless its opacity is 0. Terrain
///         relief finer than its cells.
/// Source  soil darkens with moisture, linearly in saturation: in the near infrared, saturated soil
///         reflects about half as much as dry soil (after Lobell and Asner 2002).
class RayScene {
 public:
  /// Maximum number of poses that Update accepts.
  static constexpr std::size_t kMaxPoses = 32;

  explicit RayScene(const SceneModel& model);
  ~RayScene();

  /// Sets the scene for an interval. `poses` holds 1 to kMaxPoses equally spaced times from its
  /// start to its end, each with one pose per body. The terrain and `shapes` are constant over the
  /// interval.
  void Update(const std::vector<std::vector<Pose>>& poses, const TerrainSurface& terrain,
              const Shapes& shapes = {});

  /// First hit of each ray. The result does not depend on the number of `threads`.
  void Trace(std::span<const Ray> rays, std::span<RayHit> hits, int threads) const;

  /// Bare Embree queries on the calling thread, for benchmarks: they do not evaluate the hits. The
  /// first traces ray by ray (rtcIntersect1), the second in the packets of Trace (rtcIntersect8). A
  /// miss has infinite range.
  void TraceBareSingly(std::span<const Ray> rays, std::span<float> range_m) const;
  void TraceBareInPackets(std::span<const Ray> rays, std::span<float> range_m) const;

  /// Memory that Embree holds for meshes, ground and acceleration structures.
  std::int64_t bytes() const;

  /// Number of terrain tiles built since construction.
  std::int64_t tiles_rebuilt() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Version of the linked Embree library, "3.13.5".
std::string EmbreeVersion();

}  // namespace tera
