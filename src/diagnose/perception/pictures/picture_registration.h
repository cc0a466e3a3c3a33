#pragma once

#include <array>
#include <optional>
#include <vector>

#include "diagnose/perception/pictures/picture_levels.h"
#include "diagnose/perception/pictures/picture_source.h"
#include "diagnose/perception/registration/point_residual.h"
#include "diagnose/perception/registration/scan_split.h"

namespace tera {

/// Edges of simulated pictures, and their distances from the same edges in measured pictures.
///
/// Frames  W, B, S, C as in PictureSource; T the camera under a calibration.
/// Model   landmarks: in each square of a thirtieth of the picture's width, the pixel with the
///         steepest brightness, one for each level of blur. A landmark is the point in space seen
///         there, at the nearest depth of its nine neighbours, since an edge belongs to the
///         foreground. Under another calibration it moves in the measured picture. Its residual, in
///         pixels, is the difference of brightness there over the simulated slope; its derivatives
///         use the mean of both slopes. Brightness is that of PictureLevels.
///         Noise: 0.1 over the slope; 0.2 pixels; in blurred pictures also a shift of the camera by
///         up to 0.1 m, since near parts soon leave the blur's reach. Landmarks beyond the measured
///         picture's border are not judged.
/// Omits   parts that appear or are occluded as the camera moves; moving shadows.
/// Source  Lucas and Kanade 1981; Engel, Koltun and Cremers 2018, "Direct sparse odometry"; mean of
///         slopes: Benhimane and Malis 2004.
class PictureRegistration {
 public:
  /// Renders every picture under `calibration`. Keeps a reference to the source.
  PictureRegistration(const PictureSource& source, const SensorCalibration& calibration);

  /// Landmarks of the frames of some parts.
  std::vector<ScanPoints> PointsOf(const ScanSplit& split, const std::vector<Part>& parts) const;
  /// Residuals under another calibration, at a level of PictureLevels.
  std::vector<PointResidual> ResidualsOf(const std::vector<ScanPoints>& points,
                                         const SensorCalibration& calibration, int level) const;
  /// Coefficient of correlation of measured with simulated brightness at the landmarks.
  double Correlation(const std::vector<ScanPoints>& points,
                     const SensorCalibration& calibration) const;
  double MeanLandmarks() const;  ///< of a frame

 private:
  struct Landmark {
    Vec3 p_m = Vec3::Zero();  ///< in W, or in B where it is a part of the machine
    Surface surface = Surface::kGround;
    float value = 0;               ///< simulated brightness
    Vec2 gradient = Vec2::Zero();  ///< of it, a pixel
  };
  /// Landmarks of one square of a picture, one for each level.
  using Square = std::array<std::optional<Landmark>, PictureLevels::kCount>;
  /// Where a landmark is in the measured picture.
  struct Projection {
    Vec2 px = Vec2::Zero();
    /// Derivatives of `px`.
    Eigen::Matrix<double, 2, kCalibrationElements> by_calibration =
        Eigen::Matrix<double, 2, kCalibrationElements>::Zero();
  };
  void AddLandmarks(std::size_t frame, const SimulatedPicture& simulated, const BodyState& link,
                    const SensorCalibration& calibration);
  std::optional<Landmark> LandmarkAt(const SimulatedPicture& simulated, const BodyState& link,
                                     const SensorCalibration& calibration, const Vec2& px) const;
  /// Nothing where the landmark is not before the camera.
  std::optional<Projection> Project(const Landmark& landmark, const BodyState& link,
                                    const SensorCalibration& calibration) const;

  const PictureSource& source_;
  std::vector<PictureLevels> measured_;
  std::vector<std::vector<Square>> squares_;  ///< of each frame, those with a landmark at level 0
};

}  // namespace tera
