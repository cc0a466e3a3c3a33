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

/// A lidar or camera of a layout at its pose at one moment.
struct Viewer {
  std::string name;
  ViewField field;
  int link = 0;
  Pose X_BS = Pose::Identity();  ///< the true mount
  Pose X_WS = Pose::Identity();
};

/// An obstacle between a viewer and a place.
struct Blocked {
  std::uint16_t instance = 0;  ///< scene instance; 0 is the ground
};

/// A scene at one moment, for tests of lines of sight.
///
/// Model   a place is in sight if no surface crosses the straight line to it. Surfaces within
///         `kTouch_m` before it do not count, so places on surfaces can be in sight. Glass panes
///         (opacity below 1) lie on a line but do not block viewers that see through them.
/// Omits   attenuation and reflection by a pane.
class Sighting {
 public:
  static constexpr double kTouch_m = 0.03;

  /// Keeps references.
  Sighting(const Scenario& scenario, const SceneAssembly& assembly, int threads);

  void Show(const Instant& now, const TerrainSurface& ground);

  /// One line of sight.
  struct Line {
    Vec3 from_W_m, to_W_m;
    bool through_glass = false;
  };
  /// The obstacle on each line, if any.
  std::vector<std::optional<Blocked>> Try(std::span<const Line> lines) const;
  /// An intersection of a line with a surface.
  struct Crossing {
    std::uint16_t instance = 0;  ///< scene instance; 0 is the ground
    double at_m = 0;             ///< from the line's beginning
    bool leaves = false;         ///< hit from behind: the line leaves the enclosed volume
    bool is_glass = false;
  };
  /// All surfaces on each line, in order. Only the first of surfaces within 0.1 mm counts.
  std::vector<std::vector<Crossing>> CrossingsOf(std::span<const Line> lines) const;
  /// Whether each place lies inside something solid. The nearest surface must be the same object in
  /// all of six directions; downwards it may be the ground, into which objects sink.
  std::vector<bool> AreInside(const std::vector<Vec3>& places_W_m) const;
  /// Marks the scene's instances that are parts of machine number `machine` with these classes.
  std::vector<bool> InstancesOf(std::size_t machine, bool (*is_wanted)(SemanticClass)) const;
  /// Distance from `from_W_m` along the unit vector `d_W` to the first surface of these instances,
  /// through everything else; `farthest_m` if there is none within it.
  double NearestOf(const std::vector<bool>& instances, const Vec3& from_W_m, const Vec3& d_W,
                   double farthest_m) const;
  /// RayScene::bytes.
  std::int64_t bytes() const { return scene_.bytes(); }
  /// Its name, "excavator1/boom"; "ground" for the ground.
  std::string NameOf(const Blocked& blocked) const;

 private:
  using GoesOn = std::function<bool(std::size_t line, const Crossing&)>;
  /// Follows each line from surface to surface up to `before_m` before its end, while `goes_on`
  /// holds.
  void Follow(std::span<const Line> lines, double before_m, const GoesOn& goes_on) const;

  const Scenario& scenario_;
  const SceneAssembly& assembly_;
  int threads_;
  RayScene scene_;
};

}  // namespace tera
