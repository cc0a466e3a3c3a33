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

/// Range of distances at which a layout detects a person around the machine.
///
/// Frames  H as in PolarGrid. Distances run from the machine's hull to the person's centre. The
///         hull is the outermost point of undercarriage, tracks, blade and upper structure in a
///         direction.
/// Model   the person is a box that faces the machine and stands on the ground. The number of lidar
///         points is the points per steradian times the solid angle of the box's visible parts
///         within the lidar's range at their incidence. Camera pixels are counted likewise. A
///         sensor detects the person if this number reaches the study's threshold.
///         DetectionProbability gives the probability of detection by lidar points.
/// Omits   shape and pose beyond a box; clothes of other than the study's reflectance; the image
///         processing of a detector.
class PersonRange {
 public:
  static constexpr int kSectors = PolarGrid::kSectors;
  /// Share of the lidar points on the box that lie on the body. Only DetectionProbability uses it;
  /// the study's threshold counts points on the box. Derivation: the projected area of a standing
  /// body is 0.35 (front) and 0.23 (side) of its effective radiation area (projected area factors
  /// as in ISO 7726). The effective radiation area is 0.725 of 1.8 m^2 (Fanger 1970, second-hand).
  /// This gives 0.52 and 0.57 of the box's sides. All postures share one value.
  static constexpr double kBodyOfBox = 0.5;

  PersonRange(Posture posture, const PersonStudy& study, double reflectance);

  /// Adds a moment. `hull_m` is HullRadii_m of kSectors sectors.
  void Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
           const Sighting& sighting, const TerrainSurface& ground);

  const Posture& posture() const { return posture_; }
  /// Tested distances: every metre from 1 m on.
  std::vector<double> Distances_m() const;
  /// "person/POSTURE/detected_from_m_ahead", "_left", "_behind", "_right", and likewise
  /// "detected_to_m_*" and "detected_over_m_*": the Reach that holds in all directions of the
  /// quarter. The worst direction decides.
  /// "person/POSTURE/detected_within_12m": share of the tested places with a detection. The figures
  /// of DetectionProbability follow.
  std::vector<Figure> Figures() const;
  PolarCurve Curve() const;
  /// "detected/POSTURE": share of the moments with a detection at each place. The maps of
  /// DetectionProbability follow.
  std::vector<PolarMap> Maps() const;

 private:
  /// Detection along one direction, or common to all directions of a quarter: the nearest and the
  /// farthest distance of detection, and the number of detected metres, which is smaller if there
  /// are gaps. Without any detection, `from_m` is a metre beyond the farthest tested distance, and
  /// the others are 0.
  struct Reach {
    double from_m = 0, to_m = 0, over_m = 0;
  };
  /// Samples of the layout's viewers on a person, for each place.
  struct Had {
    std::vector<bool> enough;    ///< whether at least one viewer reaches the study's threshold
    std::vector<double> points;  ///< lidar points on the body, all lidars together
  };
  Had HadOf(const std::vector<PersonPlace>& places, const Layout& layout,
            const Sighting& sighting) const;
  void AddReach(const std::vector<PersonPlace>& places, const std::vector<bool>& detected);
  /// Reach from the detection at each tested distance. A distance without a place counts as not
  /// detected.
  Reach ReachOf(const std::vector<bool>& detected) const;
  PolarMap DetectedMap() const;

  Posture posture_;
  PersonStudy study_;
  double reflectance_;
  std::vector<BodyPatch> patches_;
  /// [direction][moment].
  std::vector<std::vector<Reach>> directions_ = std::vector<std::vector<Reach>>(kSectors);
  std::vector<std::vector<Reach>> quarters_;  ///< [quarter][moment], in the order of kQuarters
  /// Number of moments for each place, by sector and step.
  std::vector<double> had_place_, had_enough_;
  std::vector<double> within_12m_;
  std::vector<std::size_t> tried_;
  DetectionProbability probability_;
};

}  // namespace tera
