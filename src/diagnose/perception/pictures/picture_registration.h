#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "diagnose/perception/registration/registration_block.h"
#include "resimulate/sensor_calibration.h"
#include "resimulate/simulated_return.h"

/// Pictures of a recorded colour camera, and their simulation.

namespace tera {

/// Pictures of one camera with their simulation.
///
/// Frames  W; B the camera's link; S the sensor as documented; C optical.
struct PictureSource {
  std::string channel;  ///< "excavator1/camera_mast"
  std::string target;   ///< the camera's name in the scenario
  EffectTarget kind = EffectTarget::kCamera;
  Pose X_BS = Pose::Identity();
  Pose X_SC = Pose::Identity();
  Effects present;  ///< of the camera, as the scenario has them
  std::vector<TimeNs> t_ns;
  std::vector<Image<float>> grey;  ///< measured, 0 to 1
  /// The picture of a frame under a possible calibration of the camera; nothing if the camera's
  /// pose at that time is unknown.
  std::function<std::optional<SimulatedPicture>(std::size_t frame,
                                                const SensorCalibration& calibration)>
      render;
  /// Motion of the link at the frame's true time.
  std::function<std::optional<BodyState>(std::size_t frame, const SensorCalibration& calibration)>
      link_at;
  std::function<Vec2(const Vec3& p_C_m)> project;          ///< pixel of a point in front of the
                                                           ///< camera
  std::function<std::optional<Vec3>(const Vec2& px)> ray;  ///< (x, y, 1) of a pixel

  /// The scenario's calibration.
  SensorCalibration calibration() const { return CalibrationUnder(X_BS, present); }
};

/// A picture with normalised exposure, at several levels of blur.
///
/// Model   (I - m) / sqrt(v + c^2). m and v are mean and variance of a window about each pixel, a
///         twentieth of the picture's width; c = 0.05. Gain, offset and vignetting cancel, and
///         noise in uniform areas stays small. Level k is this, blurred by 2^k pixels.
class PictureLevels {
 public:
  static constexpr int kCount = 4;
  static constexpr int kSmallest_px = 32;  ///< either side: four of the widest blur's
  /// `grey` is not smaller either way.
  explicit PictureLevels(const Image<float>& grey);

  /// Brightness at a point, interpolated between pixels; beyond the border as at the border.
  float At(int level, const Vec2& px) const;
  /// Gradient of the interpolated picture, by central differences over a pixel.
  Vec2 GradientAt(int level, const Vec2& px) const;
  /// Whether At and GradientAt use true pixels there, and not the repeated border.
  bool Holds(const Vec2& px) const;

 private:
  std::array<Image<float>, kCount> levels_;
};

/// Blurred by an approximate normal distribution of `sigma_px`: three moving averages, with the
/// border repeated.
Image<float> Blurred(const Image<float>& picture, double sigma_px);

/// Edges of simulated pictures, and their distances from the same edges in measured pictures.
///
/// Frames  W, B, S, C as in PictureSource; T the camera under a calibration.
/// Model   each square of a thirtieth of the picture's width has a landmark for each level of blur,
///         at the pixel with the steepest brightness. A landmark is the point in space seen there.
///         It has the nearest depth of its nine neighbours, since an edge belongs to the
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
