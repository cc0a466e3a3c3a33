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

namespace tera {

/// Pictures of one colour camera and their simulation.
///
/// Frames  W world; B the camera's link; S the sensor as documented; C the optical frame.
struct PictureSource {
  std::string channel;  ///< "excavator1/camera_mast"
  std::string target;   ///< the camera's name in the scenario
  EffectTarget kind = EffectTarget::kCamera;
  Pose X_BS = Pose::Identity();
  Pose X_SC = Pose::Identity();
  Effects present;  ///< effects on the camera in the scenario
  std::vector<TimeNs> t_ns;
  std::vector<Image<float>> grey;  ///< measured pictures, 0 to 1
  /// Renders a frame under the given calibration. Returns nothing if the camera's pose at that time
  /// is unknown.
  std::function<std::optional<SimulatedPicture>(std::size_t frame,
                                                const SensorCalibration& calibration)>
      render;
  /// Motion of the camera's link at the frame's true time.
  std::function<std::optional<BodyState>(std::size_t frame, const SensorCalibration& calibration)>
      link_at;
  std::function<Vec2(const Vec3& p_C_m)> project;  ///< pixel of a point in front of the camera
  std::function<std::optional<Vec3>(const Vec2& px)> ray;  ///< direction (x, y, 1) of a pixel, in C

  /// The scenario's calibration.
  SensorCalibration calibration() const { return CalibrationUnder(X_BS, present); }
};

/// A picture with normalised exposure, at several levels of blur.
///
/// Model   Each pixel becomes (I - m) / sqrt(v + c^2), with c = 0.05. The mean m and the variance v
///         are taken over a window about the pixel. The window is a twentieth of the picture's
///         width. The normalisation cancels gain, offset and vignetting, and keeps noise in uniform
///         areas small. Level k is blurred by 2^k pixels.
class PictureLevels {
 public:
  static constexpr int kCount = 4;
  static constexpr int kSmallest_px = 32;  ///< least width and height: four times the widest blur
  /// Requires a width and a height of at least kSmallest_px.
  explicit PictureLevels(const Image<float>& grey);

  /// Bilinear brightness at a point. Points beyond the border take the value at the border.
  float At(int level, const Vec2& px) const;
  /// Gradient of the bilinear picture, by central differences over one pixel to either side.
  Vec2 GradientAt(int level, const Vec2& px) const;
  /// True if At and GradientAt use only pixels inside the picture at this point.
  bool Holds(const Vec2& px) const;

 private:
  std::array<Image<float>, kCount> levels_;
};

/// Gaussian blur, approximated by three moving averages. The border is repeated.
Image<float> Blurred(const Image<float>& picture, double sigma_px);

/// Landmarks on edges of simulated pictures, and their residuals in the measured pictures.
///
/// Frames  W, B, S, C as in PictureSource; T the camera under a calibration.
/// Model   Each simulated picture is divided into squares of a thirtieth of its width. A square has
///         one landmark per level of blur, at its pixel with the steepest brightness. The landmark
///         is the 3D point seen at this pixel. The landmark's depth is the nearest among the pixel
///         and its eight neighbours, because an edge belongs to the foreground.
///         A calibration projects the landmark into the measured picture. The residual, in pixels,
///         is the brightness difference at the projection divided by the simulated slope. The
///         derivatives of the residual use the mean of the simulated and measured slopes.
///         Brightness is that of PictureLevels. Noise has three parts: 0.1 of brightness divided by
///         the slope; 0.2 pixels; on blurred levels also the parallax of a camera shift of up to
///         0.1 m. Landmarks outside the measured picture are not judged.
/// Omits   Parts that appear or are occluded as the camera moves; moving shadows.
/// Source  Lucas and Kanade 1981; Engel, Koltun and Cremers 2018, "Direct sparse odometry"; mean of
///         slopes: Benhimane and Malis 2004.
class PictureRegistration {
 public:
  /// Renders every picture under `calibration`. Keeps a reference to `source`.
  PictureRegistration(const PictureSource& source, const SensorCalibration& calibration);

  /// Landmarks of all frames in the given parts.
  std::vector<ScanPoints> PointsOf(const ScanSplit& split, const std::vector<Part>& parts) const;
  /// Residuals of landmarks under a calibration, at one level of PictureLevels.
  std::vector<PointResidual> ResidualsOf(const std::vector<ScanPoints>& points,
                                         const SensorCalibration& calibration, int level) const;
  /// Correlation coefficient of measured and simulated brightness to either side of the landmarks.
  double Correlation(const std::vector<ScanPoints>& points,
                     const SensorCalibration& calibration) const;
  double MeanLandmarks() const;  ///< mean number of landmarks per frame

 private:
  struct Landmark {
    Vec3 p_m = Vec3::Zero();  ///< point in W; in B for a point on the machine
    Surface surface = Surface::kGround;
    float value = 0;               ///< simulated brightness
    Vec2 gradient = Vec2::Zero();  ///< gradient of the simulated brightness, per pixel
  };
  /// Landmarks of one square of a picture, one per level.
  using Square = std::array<std::optional<Landmark>, PictureLevels::kCount>;
  /// Position of a landmark in the measured picture.
  struct Projection {
    Vec2 px = Vec2::Zero();
    Eigen::Matrix<double, 2, kCalibrationElements> by_calibration =
        Eigen::Matrix<double, 2, kCalibrationElements>::Zero();
  };
  void AddLandmarks(std::size_t frame, const SimulatedPicture& simulated, const BodyState& link,
                    const SensorCalibration& calibration);
  std::optional<Landmark> LandmarkAt(const SimulatedPicture& simulated, const BodyState& link,
                                     const SensorCalibration& calibration, const Vec2& px) const;
  /// Returns nothing if the landmark is not in front of the camera.
  std::optional<Projection> Project(const Landmark& landmark, const BodyState& link,
                                    const SensorCalibration& calibration) const;

  const PictureSource& source_;
  std::vector<PictureLevels> measured_;
  /// For each frame, the squares with a landmark at level 0.
  std::vector<std::vector<Square>> squares_;
};

}  // namespace tera
