#pragma once

#include <optional>
#include <span>
#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// What is looked at: a bit of a surface or, without a normal, a place in the air, which counts as
/// if a surface stood there that faces whoever looks.
struct Target {
  Vec3 p_W_m = Vec3::Zero();
  std::optional<Vec3> normal_W = std::nullopt;  ///< outwards
};

std::vector<Target> InTheAir(std::span<const Vec3> places_W_m);

/// What is asked of a viewer.
struct Asked {
  double reflectance = 1;   ///< diffuse, of the targets
  bool ranges = false;      ///< it is to measure where they are, not only to show them
  double least_per_m2 = 0;  ///< samples on a square metre of the surface
  /// The line of sight need not be free nearer to a target than this, or than Sighting::kTouch_m.
  double margin_m = 0;
};

/// Why a viewer does not see a target.
enum class Unseen { kOutOfView, kTooFarOrSparse, kBlocked };

/// A viewer and a target.
struct Look {
  bool sees = false;
  Unseen why = Unseen::kOutOfView;  ///< where it does not
  Blocked by;                       ///< where something is in the way
  double per_m2 = 0;  ///< points or pixels of one scan or picture on a square metre of the surface
  /// 1 sigma of its place along the line of sight, where ranges are asked: an error of depth moves
  /// a point along its ray by range / depth times as much.
  double sigma_m = 0;
};

/// Looks from a viewer at each target: what "seen" means in every measure of a layout.
///
/// Model   a target is in view where the viewer takes samples in its direction and its surface
///         faces the viewer; in reach where it is no nearer and no farther than the viewer sees
///         what returns its reflectance times the cosine of the incidence and, where ranges are
///         asked, within the limits in which it measures them, all by distances as the sensor takes
///         them (ViewField::DistanceOf); dense enough by samples per
///         steradian times cosine over the square of the range; and it is seen where nothing blocks
///         the line of sight either. Glass does not block what only has to be shown by a viewer
///         that shows what lies behind it.
/// Omits   how large a target is: its samples are those of its middle, all of it is seen or none.
std::vector<Look> LookFrom(const Viewer& viewer, std::span<const Target> targets,
                           const Asked& asked, const Sighting& sighting);

}  // namespace tera
