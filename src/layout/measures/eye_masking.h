#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure.h"
#include "layout/sight/sighting.h"
#include "layout/study/study.h"

namespace tera {

/// The number of the link that carries the eye. Throws InputError where the machine has none of
/// that name.
int LinkOfEye(const EyeStudy& eye, const MachineModel& machine);

/// A stretch of a line on the ground that the machine hides from an eye.
struct Masking {
  double azimuth_rad = 0;  ///< of its middle, about the origin of H
  double width_m = 0;
  std::vector<std::string> by;  ///< parts of the machine in the way, what hides most of it first
};

/// What a machine hides from the eye of its operator, on two lines around it.
///
/// Frames  H as in PolarGrid; B the link that carries the eye.
/// Model   two lights, half their spacing to the left and to the right of the eye, level and across
///         the line to the place that is looked at, so that the pair turns to it as a head does. A
///         place is masked where parts of the machine stand before both. The two lines: the
///         visibility test circle about the point below the eye, and the rectangular boundary, the
///         rectangle in H around what HullRadii_m counts as the machine's sides, plus a distance;
///         both on the level plane through the origin of H, for the standard's level test surface.
///         A masking on the circle is as wide as its chord, and one of half the circle or more as
///         the circle; one on the rectangle is as wide as the boundary is hidden in length.
/// Omits   mirrors and cameras, which the standard calls indirect visibility; its sectors, and its
///         criteria of performance: a masking is held against the study's own limit, if there is
///         one. The reference machine position that the standard tests in: every moment of the
///         cycle is looked at as it is. Everything that is not the machine, its panes of glass, and
///         the soil in its bucket hide nothing. Maskings narrower than 5 cm may be missed.
/// Source  ISO 5006:2017, as far as its public contents go: a circle of 12 m, a rectangular
///         boundary (1 m from the machine in the edition of 2006), lights 65, 205 or 405 mm apart;
///         its clause 9.2 admits simulation. That the circle lies about the point below the eye is
///         as in Directive 2008/2/EC, of tractors. The standard's own text was not checked.
class EyeMasking {
 public:
  explicit EyeMasking(const EyeStudy& eye) : eye_(eye) {}

  /// Adds a moment; `X_WB` is the pose of the eye's link, `machine` the number of the studied one.
  void Add(const Pose& X_WH, const Pose& X_WB, std::size_t machine, const Sighting& sighting);

  /// "eye/circle/widest_masking_m" and "masked_share", the same of "eye/rectangle"; where the study
  /// has a limit, also "exceeds_limit", 1 where the widest masking is wider.
  std::vector<Figure> Figures() const;
  /// Of each line on which the limit was exceeded, where most.
  std::vector<std::string> Warnings() const;

 private:
  struct Record {
    std::vector<std::vector<Masking>> maskings;     ///< of each moment, counterclockwise
    std::vector<double> masked_share, share_error;  ///< of each
  };

  EyeStudy eye_;
  Record circle_, rectangle_;
};

}  // namespace tera
