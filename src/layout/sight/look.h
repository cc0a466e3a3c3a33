#pragma once

#include <optional>
#include <span>
#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// A small surface patch. Without a normal it is a place in the air, and counts as a surface that
/// faces the viewer.
struct Target {
  Vec3 p_W_m = Vec3::Zero();
  std::optional<Vec3> normal_W = std::nullopt;  ///< unit, outward
};

std::vector<Target> InTheAir(std::span<const Vec3> places_W_m);

/// Conditions under which a viewer sees a target.
struct Asked {
  double reflectance = 1;   ///< of the target, diffuse
  bool ranges = false;      ///< the viewer must measure distances: excludes colour cameras
  double least_per_m2 = 0;  ///< required samples per square metre of the surface
  /// Distance before a target within which occluders are ignored; at least Sighting::kTouch_m.
  double margin_m = 0;
};

/// Why a viewer does not see a target.
enum class Unseen { kOutOfView, kTooFarOrSparse, kBlocked };

/// A viewer's view of one target.
struct Look {
  bool sees = false;
  Unseen why = Unseen::kOutOfView;  ///< valid if it is not seen
  Blocked by;                       ///< the occluder if `why` is kBlocked
  double per_m2 = 0;  ///< points or pixels of one scan or picture per square metre of the surface
  /// 1 sigma of the measured position along the line of sight, for ranging viewers. A depth error
  /// is converted to the ray: it counts range / depth times.
  double sigma_m = 0;
};

/// View of a viewer on each target. This function defines "seen" for every measure of a layout.
///
/// Model   a target is seen if it passes four tests:
///         1. In view: the viewer has samples in its direction, and its surface faces the viewer.
///         2. In reach: its distance is within the viewer's limits for the target's reflectance
///            times the cosine of incidence. If distances are required, the measuring limits apply
///            too. Distances follow the sensor's convention (ViewField::DistanceOf).
///         3. Dense enough: (samples per steradian) cos(incidence) / range^2 is at least
///            `least_per_m2`.
///         4. Free line of sight. Glass does not block it if distances are not required and the
///            viewer sees through glass.
/// Omits   the target's size: the samples at its centre hold for the whole target, which is seen
///         completely or not at all.
std::vector<Look> LookFrom(const Viewer& viewer, std::span<const Target> targets,
                           const Asked& asked, const Sighting& sighting);

}  // namespace tera
