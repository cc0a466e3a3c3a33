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

/// A lidar or camera of a layout, where it is at one moment.
struct Viewer {
  std::string name;
  ViewField field;
  int link = 0;
  Pose X_BS = Pose::Identity();  ///< as it truly is
  Pose X_WS = Pose::Identity();
};

/// What stands between a viewer and a place.
struct Blocked {
  std::uint16_t instance = 0;  ///< of the scene; 0 is the ground
};

/// A scene at one moment, in which lines of sight are tried.
///
/// Model   a place is in sight where no surface lies on the straight line to it but within
///         `kTouch_m` before it, so that places on surfaces are in sight of what looks at them.
///         Panes of glass, surfaces whose opacity is below 1, lie on a line but do not block what
///         shows through them.
/// Omits   what a pane takes of the light and what it mirrors.
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
  /// Of each line what blocks it, if anything does.
  std::vector<std::optional<Blocked>> Try(std::span<const Line> lines) const;
  /// A surface that a line goes through.
  struct Crossing {
    std::uint16_t instance = 0;  ///< of the scene; 0 is the ground
    double at_m = 0;             ///< from the line's beginning
    bool leaves = false;         ///< met from behind: the line comes out of what it encloses
    bool is_glass = false;
  };
  /// Of each line all surfaces on it, in order; of surfaces within 0.1 mm the first.
  std::vector<std::vector<Crossing>> CrossingsOf(std::span<const Line> lines) const;
  /// Whether each place lies inside something solid: in all of six directions the same object is
  /// what is next, or the ground below, into which objects are sunk.
  std::vector<bool> AreInside(const std::vector<Vec3>& places_W_m) const;
  /// Which of the scene's instances are parts of machine number `machine` of these classes.
  std::vector<bool> InstancesOf(std::size_t machine, bool (*is_wanted)(SemanticClass)) const;
  /// How far from `from_W_m` along the unit vector `d_W` the first surface of these instances is,
  /// whatever lies before it; `farthest_m` where there is none within it.
  double NearestOf(const std::vector<bool>& instances, const Vec3& from_W_m, const Vec3& d_W,
                   double farthest_m) const;
  /// RayScene::bytes.
  std::int64_t bytes() const { return scene_.bytes(); }
  /// Its name, "excavator1/boom"; of the ground "ground".
  std::string NameOf(const Blocked& blocked) const;

 private:
  using GoesOn = std::function<bool(std::size_t line, const Crossing&)>;
  /// Goes along each line to `before_m` before its end, from surface to surface for as long as
  /// `goes_on` says.
  void Follow(std::span<const Line> lines, double before_m, const GoesOn& goes_on) const;

  const Scenario& scenario_;
  const SceneAssembly& assembly_;
  int threads_;
  RayScene scene_;
};

}  // namespace tera
