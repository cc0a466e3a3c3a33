#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure.h"
#include "layout/sight/sighting.h"
#include "layout/study/study.h"

namespace tera {

/// Index of the link that carries the eye. Throws InputError if the machine has no link with that
/// name.
int LinkOfEye(const EyeStudy& eye, const MachineModel& machine);

/// A stretch of a line on the ground that the machine hides from an eye.
struct Masking {
  double azimuth_rad = 0;  ///< azimuth of its middle, about the origin of H
  double width_m = 0;
  std::vector<std::string> by;  ///< occluding parts of the machine, largest share first
};

/// Maskings of the operator's view by the machine, on two lines around it.
///
/// Frames  H as in PolarGrid; B the link that carries the eye.
/// Model   two lights lie half their spacing to the left and right of the eye, level and
///         perpendicular to the line of sight. The pair turns as a head does. A place is masked if
///         parts of the machine occlude it from both lights. The first line is the visibility test
///         circle about the point below the eye. The second is the rectangular boundary: the
///         rectangle in H around the sides of HullRadii_m, plus a distance. Both lie on the level
///         plane through the origin of H, which stands for the standard's level test surface. The
///         width of a masking on the circle is its chord, or the diameter from half the circle on.
///         The width on the rectangle is the masked length of the boundary.
/// Omits   mirrors and cameras (indirect visibility in the standard). The standard's sectors and
///         performance criteria: maskings are compared with the study's own limit, if it has one.
///         The reference machine position of the standard: every moment of the cycle is evaluated
///         as it is. Occlusion by other objects, by the machine's glass panes and by the soil in
///         its bucket. Maskings narrower than 5 cm may be missed.
/// Source  ISO 5006:2017, from its public contents: a circle of 12 m, a rectangular boundary (1 m
///         from the machine in the edition of 2006), lights 65, 205 or 405 mm apart. Its clause 9.2
///         admits simulation. The circle's centre below the eye follows Directive 2008/2/EC for
///         tractors. The standard's own text was not checked.
class EyeMasking {
 public:
  explicit EyeMasking(const EyeStudy& eye) : eye_(eye) {}

  /// Adds a moment. `X_WB` is the pose of the eye's link, `machine` the index of the studied
  /// machine.
  void Add(const Pose& X_WH, const Pose& X_WB, std::size_t machine, const Sighting& sighting);

  /// "eye/circle/widest_masking_m" and "masked_share", and the same for "eye/rectangle". If the
  /// study has a limit, also "exceeds_limit", 1 if the widest masking is wider.
  std::vector<Figure> Figures() const;
  /// For each line that exceeded the limit, a warning with the worst place.
  std::vector<std::string> Warnings() const;

 private:
  struct Record {
    std::vector<std::vector<Masking>> maskings;     ///< one list per moment, counterclockwise
    std::vector<double> masked_share, share_error;  ///< one per moment
  };

  EyeStudy eye_;
  Record circle_, rectangle_;
};

}  // namespace tera
