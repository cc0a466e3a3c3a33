#pragma once

#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/detection_probability.h"
#include "layout/measures/figure.h"
#include "layout/measures/person_samples.h"
#include "layout/measures/polar_grid.h"
#include "layout/measures/polar_map.h"
#include "layout/study/study.h"

namespace tera {

/// From where a person would be detected, if she stood around the machine.
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
  /// Of each direction, moment by moment: the farthest distance up to which she is detected at
  /// every one tried, 0 where not even at the first.
  const std::vector<std::vector<double>>& Detected_m() const { return detected_m_; }
  /// "person/POSTURE/detected_to_m_ahead", "_left", "_behind", "_right": the least over the
  /// directions of that quarter. "person/POSTURE/detected_within_12m": share of the places tried.
  /// Those of DetectionProbability.
  std::vector<Figure> Figures() const;
  PolarCurve Curve() const;
  std::vector<PolarMap> Maps() const { return probability_.Maps(); }

 private:
  /// What the viewers of a layout have of her at places, each place alone.
  struct Had {
    std::vector<bool> enough;    ///< one of them has as much as the study asks
    std::vector<double> points;  ///< of all lidars together, on her body
  };
  Had HadOf(const std::vector<PersonPlace>& places, const Layout& layout,
            const Sighting& sighting) const;
  void AddRange(const std::vector<PersonPlace>& places, const std::vector<bool>& detected);

  Posture posture_;
  PersonStudy study_;
  double reflectance_;
  std::vector<BodyPatch> patches_;
  std::vector<std::vector<double>> detected_m_ = std::vector<std::vector<double>>(kSectors);
  std::vector<double> within_12m_;
  std::vector<std::size_t> tried_;
  DetectionProbability probability_;
};

}  // namespace tera
