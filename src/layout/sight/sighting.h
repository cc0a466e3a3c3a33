#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/motion.h"
#include "render/rays/ray_scene.h"
#include "sensors/view_field.h"
#include "sim/scene_assembly.h"
#include "sim/world_state.h"

namespace tera {

/// A lidar or camera of a layout. `X_WS` is its pose at the current moment.
struct Viewer {
  std::string name;
  ViewField field;
  int link = 0;
  Pose X_BS = Pose::Identity();  ///< true mount, which may deviate from the nominal one
  Pose X_WS = Pose::Identity();
};

/// An occluder on a line of sight.
struct Blocked {
  std::uint16_t instance = 0;  ///< scene instance; 0 is the ground
};

/// The scene at one moment, for line-of-sight queries.
///
/// Model   a place is in sight if no surface crosses the straight line to it. Surfaces within
///         `kTouch_m` before the place are ignored, so that places on surfaces can be in sight.
///         Glass panes (opacity below 1) block only viewers that do not see through glass.
/// Omits   attenuation and reflection by a pane.
class Sighting {
 public:
  static constexpr double kTouch_m = 0.03;

  /// Keeps references to `scenario` and `assembly`.
  Sighting(const Scenario& scenario, const SceneAssembly& assembly, int threads);

  void Show(const Instant& now, const TerrainSurface& ground);

  struct Line {
    Vec3 from_W_m, to_W_m;
    bool through_glass = false;
  };
  /// The occluder on each line, if any.
  std::vector<std::optional<Blocked>> Try(std::span<const Line> lines) const;
  /// An intersection of a line with a surface.
  struct Crossing {
    std::uint16_t instance = 0;  ///< scene instance; 0 is the ground
    double at_m = 0;             ///< distance from the start of the line
    bool leaves = false;         ///< hit from behind: the line leaves the enclosed volume
    bool is_glass = false;
  };
  /// All surface crossings of each line, in order. Of surfaces closer than 0.1 mm to each other,
  /// only the first counts.
  std::vector<std::vector<Crossing>> CrossingsOf(std::span<const Line> lines) const;
  /// Whether each place lies inside a solid object: the nearest surfaces in all six axis directions
  /// must belong to the same object. The downward one may be the ground, because objects sink into
  /// it.
  std::vector<bool> AreInside(const std::vector<Vec3>& places_W_m) const;
  /// One flag per scene instance: whether it is a part of machine number `machine` with a wanted
  /// class.
  std::vector<bool> InstancesOf(std::size_t machine, bool (*is_wanted)(SemanticClass)) const;
  /// Distance from `from_W_m` along the unit vector `d_W` to the first surface of the marked
  /// instances. All other surfaces are ignored. `farthest_m` if there is none within it.
  double NearestOf(const std::vector<bool>& instances, const Vec3& from_W_m, const Vec3& d_W,
                   double farthest_m) const;
  /// Memory of the scene (RayScene::bytes).
  std::int64_t bytes() const { return scene_.bytes(); }
  /// Scene name of the occluder, "excavator1/boom", or "ground".
  std::string NameOf(const Blocked& blocked) const;

 private:
  using GoesOn = std::function<bool(std::size_t line, const Crossing&)>;
  /// Follows each line from surface to surface while `goes_on` returns true. Stops `before_m`
  /// before the end of the line.
  void Follow(std::span<const Line> lines, double before_m, const GoesOn& goes_on) const;

  const Scenario& scenario_;
  const SceneAssembly& assembly_;
  int threads_;
  RayScene scene_;
};

}  // namespace tera
