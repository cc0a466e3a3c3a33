#pragma once

#include <span>
#include <string>
#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// A sensor that is mounted inside the machine's own mesh.
struct BuriedMount {
  std::string viewer;
  std::string part;    ///< the part's scene name: "excavator1/boom"
  double depth_m = 0;  ///< distance from the mount to the nearest surface of that part
};

/// Finds viewers that are mounted inside the machine that carries them.
///
/// Model   rays leave the mount in 100 directions, uniform over the sphere. For each part, the
///         exits and the entries along a ray are counted. The two numbers differ if the ray starts
///         inside a closed surface, or inside a union of closed surfaces. A mount is inside a part
///         if they differ in more than half of the directions. The mount must also be at least 1 cm
///         from the part's surface, so that a mount on the surface does not count.
/// Omits   the sensor's own body: it may cut the machine although the mount is outside. Parts with
///         open surfaces, which have no inside. A cab counts as hollow.
class MountCheck {
 public:
  static constexpr double kLeastDepth_m = 0.01;

  /// Adds a moment. `machine` is the index of the machine that carries the viewers.
  void Add(std::size_t machine, std::span<const Viewer> viewers, const Sighting& sighting);

  /// One entry per viewer and part, with the maximum depth over the moments.
  const std::vector<BuriedMount>& Buried() const { return buried_; }
  /// "camera_front: its mount lies 0.12 m inside excavator1/boom; ...".
  std::vector<std::string> Warnings() const;

 private:
  void Keep(const BuriedMount& found);

  std::vector<BuriedMount> buried_;
};

}  // namespace tera
