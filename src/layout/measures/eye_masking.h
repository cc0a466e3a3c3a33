#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure.h"
#include "layout/sight/sighting.h"
#include "layout/study/study.h"

namespace tera {

/// Index of the link that carries the eye. Throws InputError if the machine lacks it.
int LinkOfEye(const EyeStudy& eye, const MachineModel& machine);

/// A stretch of a test line on the ground that the machine hides from the operator's eyes.
struct Masking {
  double azimuth_rad = 0;  ///< azimuth of its midpoint about the origin of H
  double width_m = 0;
  std::vector<std::string> by;  ///< occluding machine parts, largest share first
};

/// Masking of the operator's view by the machine, measured on two closed lines around it.
///
/// Frames  H as in PolarGrid; B is the link that carries the eye.
/// Model   two lights stand for the eyes. They lie half their spacing to the left and right of the
///         eye point, level and perpendicular to the line of sight. For each tested place the pair
///         turns towards that place, as a head does. A place is masked if parts of the machine
///         occlude it from both lights.
///         The first line is the visibility test circle about the point below the eye. The second
///         is the rectangular boundary: the bounding rectangle of HullRadii_m in H, enlarged by a
///         margin. Both lie in the level plane through the origin of H, which stands for the
///         standard's level test surface.
///         The width of a masking on the circle is its chord, or the diameter if it spans half the
///         circle or more. Its width on the rectangle is its length along the boundary.
/// Omits   mirrors and cameras (indirect visibility in the standard). Sectors and performance
///         criteria of the standard: the limit, if any, is the study's own. The standard's
///         reference position of the machine: each moment of the cycle is evaluated in its own
///         pose. Occlusion by other objects, by the machine's glass panes and by soil in its
///         bucket. Maskings narrower than 5 cm may be missed.
/// Source  ISO 5006:2017, from its public contents: a circle of 12 m, a rectangular boundary (1 m
///         from the machine in the edition of 2006), lights 65, 205 or 405 mm apart. Its clause 9.2
///         admits simulation. The circle's centre below the eye follows Directive 2008/2/EC for
///         tractors. The standard's own text was not checked.
class EyeMasking {
 public:
  explicit EyeMasking(const EyeStudy& eye) : eye_(eye) {}

  /// Adds a moment. X_WB is the pose of the link that carries the eye; `machine` is the studied
  /// machine's index.
  void Add(const Pose& X_WH, const Pose& X_WB, std::size_t machine, const Sighting& sighting);

  /// "eye/circle/widest_masking_m" and "masked_share", and the same for "eye/rectangle". If the
  /// study has a limit, also "exceeds_limit": 1 if the widest masking exceeds it, else 0.
  std::vector<Figure> Figures() const;
  /// One warning for each line whose widest masking exceeds the limit, with the worst place.
  std::vector<std::string> Warnings() const;

 private:
  struct Record {
    std::vector<std::vector<Masking>> maskings;     ///< [moment], counterclockwise
    std::vector<double> masked_share, share_error;  ///< one per moment
  };

  EyeStudy eye_;
  Record circle_, rectangle_;
};

}  // namespace tera
