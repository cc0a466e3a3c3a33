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

/// From where to where a person would be detected, if she stood around the machine.
///
/// Frames  H as in PolarGrid. Distances are from the hull of the machine: the outermost point of
///         its undercarriage, tracks, blade and upper structure in a direction, to her middle.
/// Model   she is a box that faces the machine and stands on the ground. Points of a lidar on her:
///         its points per steradian times the solid angle of the parts of her that it sees, within
///         its reach at the incidence there; pixels of a camera alike. She is detected by a sensor
///         that has as many on her as the study asks. With what probability lidars detect her by
///         their points is DetectionProbability.
/// Omits   her shape and pose beyond a box; clothes other than of the study's reflectance; what a
///         detector makes of pixels.
class PersonRange {
 public:
  static constexpr int kSectors = PolarGrid::kSectors;
  /// Share of the points on her box that lie on her body, for the probability; the threshold counts
  /// those on the box. A standing body is seen from the front as 0.35 and from the side as 0.23 of
  /// its effective radiation area (projected area factors as in ISO 7726), which is 0.725 of 1.8
  /// m^2 (Fanger 1970, second-hand): 0.52 and 0.57 of the sides of the common box. One share for
  /// all postures.
  static constexpr double kBodyOfBox = 0.5;

  PersonRange(Posture posture, const PersonStudy& study, double reflectance);

  /// `hull_m` is HullRadii_m of kSectors sectors.
  void Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
           const Sighting& sighting, const TerrainSurface& ground);

  const Posture& posture() const { return posture_; }
  /// Distances that are tried: every metre from 1 m on.
  std::vector<double> Distances_m() const;
  /// "person/POSTURE/detected_from_m_ahead", "_left", "_behind", "_right", "detected_to_m_*" and
  /// "detected_over_m_*": Reach of what is detected in every direction of that quarter, so that the
  /// worst direction decides. "person/POSTURE/detected_within_12m": share of the places tried.
  /// Those of DetectionProbability.
  std::vector<Figure> Figures() const;
  PolarCurve Curve() const;
  /// "detected/POSTURE": the share of the moments at which each place has as much on her as the
  /// study asks. Those of DetectionProbability.
  std::vector<PolarMap> Maps() const;

 private:
  /// The distances at which she is detected in a direction, or in all directions of a quarter: the
  /// nearest, the farthest, and how many metres of them, which are fewer than from the one to the
  /// other where she is not detected in between. Where she is at none, `from_m` is a metre beyond
  /// the farthest that is tried, and the others are 0.
  struct Reach {
    double from_m = 0, to_m = 0, over_m = 0;
  };
  /// What the viewers of a layout have of her at places, each place alone.
  struct Had {
    std::vector<bool> enough;    ///< one of them has as much as the study asks
    std::vector<double> points;  ///< of all lidars together, on her body
  };
  Had HadOf(const std::vector<PersonPlace>& places, const Layout& layout,
            const Sighting& sighting) const;
  void AddReach(const std::vector<PersonPlace>& places, const std::vector<bool>& detected);
  /// Of what is detected at each distance; a distance without a place counts as not detected.
  Reach ReachOf(const std::vector<bool>& detected) const;
  PolarMap DetectedMap() const;

  Posture posture_;
  PersonStudy study_;
  double reflectance_;
  std::vector<BodyPatch> patches_;
  /// One of each direction, moment by moment.
  std::vector<std::vector<Reach>> directions_ = std::vector<std::vector<Reach>>(kSectors);
  std::vector<std::vector<Reach>> quarters_;    ///< as kQuarters; of each moment
  std::vector<double> had_place_, had_enough_;  ///< moments of each place, by sector and step
  std::vector<double> within_12m_;
  std::vector<std::size_t> tried_;
  DetectionProbability probability_;
};

}  // namespace tera
