#pragma once

#include <span>
#include <string>
#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// A sensor whose mount lies inside the machine's own mesh.
struct BuriedMount {
  std::string viewer;
  std::string part;    ///< of the machine, as in the scene: "excavator1/boom"
  double depth_m = 0;  ///< from the mount to the nearest surface of that part
};

/// Whether the viewers of a layout are mounted inside the machine that carries them.
///
/// Model   lines from the mount in 100 directions, evenly over the sphere. Along each, surfaces of
///         a part that the line comes out of are counted against those that it goes into: in a
///         closed surface, and in any union of such, they differ. A mount is inside a part where
///         they do in most of the directions, and deeper than 1 cm, so that what is mounted on a
///         surface is not inside.
/// Omits   the sensor's own body: a mount in the air whose body cuts the machine is not found;
///         parts that are drawn as open surfaces, which have no inside. A cab is hollow.
class MountCheck {
 public:
  static constexpr double kLeastDepth_m = 0.01;

  /// Adds a moment; `machine` is the number of the one that carries the viewers.
  void Add(std::size_t machine, std::span<const Viewer> viewers, const Sighting& sighting);

  /// Of each viewer and part the deepest over the moments.
  const std::vector<BuriedMount>& Buried() const { return buried_; }
  /// "camera_front: its mount lies 0.12 m inside excavator1/boom; ...".
  std::vector<std::string> Warnings() const;

 private:
  void Keep(const BuriedMount& found);

  std::vector<BuriedMount> buried_;
};

}  // namespace tera
