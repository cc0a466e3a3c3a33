#pragma once

#include <span>
#include <string>
#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// A sensor whose mount lies inside the machine's own mesh.
struct BuriedMount {
  std::string viewer;
  std::string part;    ///< machine part, by its scene name: "excavator1/boom"
  double depth_m = 0;  ///< from the mount to the nearest surface of that part
};

/// Detects viewers that are mounted inside the machine that carries them.
///
/// Model   lines leave the mount in 100 directions, uniform over the sphere. For each part, exits
///         and entries of a line are counted; inside a closed surface, or any union of such, they
///         differ. A mount is inside a part if they differ in most directions and it is deeper than
///         1 cm; mounts on a surface thus stay outside.
/// Omits   the sensor's own body: a mount in the air whose body cuts the machine is not found;
///         parts with open surfaces, which have no inside. A cab is hollow.
class MountCheck {
 public:
  static constexpr double kLeastDepth_m = 0.01;

  /// Adds a moment; `machine` is the index of the machine that carries the viewers.
  void Add(std::size_t machine, std::span<const Viewer> viewers, const Sighting& sighting);

  /// The deepest over the moments, for each viewer and part.
  const std::vector<BuriedMount>& Buried() const { return buried_; }
  /// "camera_front: its mount lies 0.12 m inside excavator1/boom; ...".
  std::vector<std::string> Warnings() const;

 private:
  void Keep(const BuriedMount& found);

  std::vector<BuriedMount> buried_;
};

}  // namespace tera
