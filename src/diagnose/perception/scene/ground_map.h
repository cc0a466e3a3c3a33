#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "diagnose/perception/registration/scan_split.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Height of the measured ground over the simulated one in one square of the site.
struct GroundCell {
  double above_m = 0;  ///< median over blocks of time of the median of points
  double sigma_m = 0;  ///< standard deviation of above_m
  std::size_t blocks = 0;
  int region = -1;   ///< index of the region to which it belongs; -1: none
  bool seen = true;  ///< false: taken over from the nearest that is
};

/// A place where the measured ground lies elsewhere than the simulated one.
struct GroundRegion {
  double area_m2 = 0;
  double volume_m3 = 0;  ///< measured less simulated: below 0 where soil is missing
  double mean_m = 0, lowest_m = 0, highest_m = 0;
  Vec2 centre_W_m = Vec2::Zero(), low_W_m = Vec2::Zero(), high_W_m = Vec2::Zero();
  bool upright = false;  ///< higher, and too steep for soil: an object
  double p_chosen = 1, p_confirmed = 1;
  /// Distance of the measured ground to the simulated one on FINAL: as it is, and with the map.
  double rmse_before_m = 0, rmse_after_m = 0;
  std::vector<std::pair<double, double>> intervals_s;  ///< when; empty: all the time
};

/// Squares of the site by index; the lower corner of (i, j) is at cell_m * (i, j).
struct GroundMap {
  double cell_m = 0.25;
  std::map<std::pair<int, int>, GroundCell> cells;
  std::vector<GroundRegion> regions;
  std::vector<GroundRegion> unconfirmed;
  /// Points that a region explains.
  PointFlags explained;
};

/// Compares measured with simulated ground, place by place.
///
/// Frames  W.
/// Model   height of each point over the simulated ground below it, but for points on simulated
///         objects and on their edges (a ray turned by up to 1.2 deg would meet one there). Of a
///         square of 0.25 m the median of each block of time, and Student's t of these over blocks,
///         their variance moderated by eight blocks that agree within 2 cm, each with an error of 1
///         cm that no number of scans makes smaller. Squares of 5 cm and
///         more that Benjamini and Hochberg keep at one false in a hundred, found on TRAIN and
///         SELECT, make regions of four and more, of one sign, with gaps of up to half a metre,
///         which unseen squares in between take over. A region stays that on FINAL is at least half
///         as high again, at one per cent over the regions. The two halves of the recording are
///         looked at alone too.
/// Omits   what no ray met; ground that moves and moves back.
/// Source  Benjamini and Hochberg 1995; moderated t: Smyth 2004.
///
/// `scale`: of the sensor's noise over its model. `excluded`: points that something else explains.
GroundMap CompareGround(const RangeSource& source, const ScanSplit& split,
                        const SensorCalibration& calibration, double scale,
                        const PointFlags& excluded);

}  // namespace tera
