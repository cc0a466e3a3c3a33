#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/detection_probability.h"
#include "layout/measures/figure.h"
#include "layout/measures/person_samples.h"
#include "layout/measures/polar_grid.h"
#include "layout/measures/polar_map.h"
#include "layout/study/study.h"

namespace tera {

/// Range of distances at which a person around the machine would be detected.
///
/// Frames  H as in PolarGrid. Distances run from the machine's hull to the person's middle. The
///         hull is the outermost point of undercarriage, tracks, blade and upper structure in a
///         direction.
/// Model   the person is a box that faces the machine and stands on the ground. Lidar points on the
///         person are the points per steradian times the solid angle of the visible parts of the
///         box, within the lidar's reach at that incidence. Camera pixels likewise. A sensor
///         detects the person if it has as many as the study requires. DetectionProbability gives
///         the probability of detection by lidar points.
/// Omits   shape and pose beyond a box; clothes other than of the study's reflectance; the
///         detector's use of pixels.
class PersonRange {
 public:
  static constexpr int kSectors = PolarGrid::kSectors;
  /// Share of the points on the box that lie on the body, for the probability. The threshold counts
  /// points on the box. A standing body's projected area is 0.35 from the front and 0.23 from the
  /// side of its effective radiation area (projected area factors as in ISO 7726). The area is
  /// 0.725 of 1.8 m^2 (Fanger 1970, second-hand). This gives 0.52 and 0.57 of the sides of the
  /// common box. All postures share one value.
  static constexpr double kBodyOfBox = 0.5;

  PersonRange(Posture posture, const PersonStudy& study, double reflectance);

  /// `hull_m` is HullRadii_m of kSectors sectors.
  void Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
           const Sighting& sighting, const TerrainSurface& ground);

  const Posture& posture() const { return posture_; }
  /// Tested distances: every metre from 1 m on.
  std::vector<double> Distances_m() const;
  /// "person/POSTURE/detected_from_m_ahead", "_left", "_behind", "_right", "detected_to_m_*" and
  /// "detected_over_m_*": Reach over all directions of the quarter, so the worst direction decides.
  /// "person/POSTURE/detected_within_12m": share of the tested places. Also the figures of
  /// DetectionProbability.
  std::vector<Figure> Figures() const;
  PolarCurve Curve() const;
  /// "detected/POSTURE": share of the moments at which each place has as many samples as the study
  /// requires. Also the maps of DetectionProbability.
  std::vector<PolarMap> Maps() const;

 private:
  /// Distances of detection in a direction, or in all directions of a quarter. The nearest, the
  /// farthest, and the detected metres, which are fewer if there are gaps. Without a detection,
  /// `from_m` is a metre beyond the farthest tested distance, and the others are 0.
  struct Reach {
    double from_m = 0, to_m = 0, over_m = 0;
  };
  /// Samples of the viewers of a layout on a person at each place.
  struct Had {
    std::vector<bool> enough;    ///< one viewer has as many as the study requires
    std::vector<double> points;  ///< points of all lidars together, on the body
  };
  Had HadOf(const std::vector<PersonPlace>& places, const Layout& layout,
            const Sighting& sighting) const;
  void AddReach(const std::vector<PersonPlace>& places, const std::vector<bool>& detected);
  /// Reach from the detection at each distance. A distance without a place counts as not detected.
  Reach ReachOf(const std::vector<bool>& detected) const;
  PolarMap DetectedMap() const;

  Posture posture_;
  PersonStudy study_;
  double reflectance_;
  std::vector<BodyPatch> patches_;
  /// [direction][moment].
  std::vector<std::vector<Reach>> directions_ = std::vector<std::vector<Reach>>(kSectors);
  std::vector<std::vector<Reach>> quarters_;    ///< [quarter][moment], in the order of kQuarters
  std::vector<double> had_place_, had_enough_;  ///< moments per place, by sector and step
  std::vector<double> within_12m_;
  std::vector<std::size_t> tried_;
  DetectionProbability probability_;
};

}  // namespace tera
