#pragma once

#include <optional>
#include <span>
#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// A patch of a surface. Without a normal it is a place in the air, which counts as a surface that
/// faces the viewer.
struct Target {
  Vec3 p_W_m = Vec3::Zero();
  std::optional<Vec3> normal_W = std::nullopt;  ///< outward
};

std::vector<Target> InTheAir(std::span<const Vec3> places_W_m);

/// Demands on a viewer.
struct Asked {
  double reflectance = 1;   ///< diffuse, of the targets
  bool ranges = false;      ///< the viewer must measure distances, not only show the targets
  double least_per_m2 = 0;  ///< samples on a square metre of the surface
  /// Occlusion within this distance of a target, or within Sighting::kTouch_m, is ignored.
  double margin_m = 0;
};

/// Why a viewer does not see a target.
enum class Unseen { kOutOfView, kTooFarOrSparse, kBlocked };

/// A viewer's view of a target.
struct Look {
  bool sees = false;
  Unseen why = Unseen::kOutOfView;  ///< if it is not seen
  Blocked by;                       ///< if something is in the way
  double per_m2 = 0;  ///< points or pixels of one scan or picture on a square metre of the surface
  /// 1 sigma of its position along the line of sight, for ranging. A depth error moves a point
  /// along its ray by range / depth times as much.
  double sigma_m = 0;
};

/// View from a viewer to each target. Defines "seen" for every measure of a layout.
///
/// Model   a target is in view if the viewer takes samples in its direction and its surface faces
///         the viewer. It is in reach if its distance lies within the viewer's limits for its
///         reflectance times the cosine of the incidence. For ranging, the measuring limits also
///         apply. Distances follow the sensor's convention (ViewField::DistanceOf). Its density is
///         samples per steradian times cosine over the squared range. It is seen if it also has
///         enough density and a free line of sight. Glass does not block a target that needs no
///         ranging for a viewer that shows objects behind glass.
/// Omits   the target's size: its samples are those of its middle, and it is seen as a whole or not
///         at all.
std::vector<Look> LookFrom(const Viewer& viewer, std::span<const Target> targets,
                           const Asked& asked, const Sighting& sighting);

}  // namespace tera
