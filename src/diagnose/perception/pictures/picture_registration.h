#pragma once

#include <array>
#include <optional>
#include <vector>

#include "diagnose/perception/pictures/picture_levels.h"
#include "diagnose/perception/pictures/picture_source.h"
#include "diagnose/perception/scans/scan_split.h"
#include "diagnose/perception/scans/sensor_fit.h"

namespace tera {

/// Edges of simulated pictures, and how far from them the measured pictures show the same.
///
/// Frames  W, B, S, C as of PictureSource.
/// Model   of each square of a thirtieth of the picture's width the pixel of the steepest
///         brightness is a landmark, one for each degree of blur: the point in space that is seen
///         there, at the nearest depth of its nine neighbours, since an edge belongs to what stands
///         before. Under other numbers the landmark moves in the measured picture. Its residual, in
///         pixels, is the difference of brightness there over the simulated slope; its derivatives
///         are by the mean of both slopes. Brightness is that of PictureLevels. Noise: 0.1 over the
///         slope, 0.2 pixels, and in blurred pictures, whose reach what is near soon leaves, a
///         shift of the camera by up to 0.1 m. Beyond the border of the measured picture a landmark
///         is not judged.
/// Omits   what comes into sight or is hidden as the camera moves; shadows that move.
/// Source  Lucas and Kanade 1981; Engel, Koltun and Cremers 2018, "Direct sparse odometry"; mean of
///         slopes: Benhimane and Malis 2004.
class PictureRegistration {
 public:
  /// Renders every picture under `numbers`.
  PictureRegistration(const PictureSource& source, const SensorNumbers& numbers);

  /// Landmarks of the frames of some parts.
  std::vector<ScanPoints> PointsOf(const ScanSplit& split, const std::vector<Part>& parts) const;
  /// Residuals under other numbers, at a level of PictureLevels.
  std::vector<PointResidual> Compare(const std::vector<ScanPoints>& points,
                                     const SensorNumbers& numbers, int level) const;
  /// Correlation of measured with simulated brightness at the landmarks.
  double Likeness(const std::vector<ScanPoints>& points, const SensorNumbers& numbers) const;
  double LandmarksOfFrame() const;  ///< on average

 private:
  struct Landmark {
    Vec3 p_m = Vec3::Zero();  ///< in W, or in B where it moves with the link
    Surface surface = Surface::kGround;
    float value = 0;
    Vec2 slope = Vec2::Zero();
  };
  /// What one square of a picture holds at each level.
  using Square = std::array<std::optional<Landmark>, PictureLevels::kCount>;
  /// A landmark in the measured picture, with the derivatives of its place.
  struct Seen {
    Vec2 px = Vec2::Zero();
    Eigen::Matrix<double, 2, SensorNumbers::kCount> slope =
        Eigen::Matrix<double, 2, SensorNumbers::kCount>::Zero();
  };
  void AddLandmarks(std::size_t frame, const SimulatedPicture& simulated, const BodyState& link,
                    const SensorNumbers& numbers);
  std::optional<Landmark> LandmarkAt(const SimulatedPicture& simulated, const BodyState& link,
                                     const SensorNumbers& numbers, const Vec2& px) const;
  std::optional<Seen> SeenAt(const Landmark& landmark, const BodyState& link,
                             const SensorNumbers& numbers) const;

  const PictureSource& source_;
  std::vector<PictureLevels> measured_;
  std::vector<std::vector<Square>> squares_;  ///< of each frame, those with a landmark in full
};

}  // namespace tera
