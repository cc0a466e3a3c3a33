#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "sensors/camera/optics/optics_model.h"

namespace tera {

/// Angular distribution of the light that a lens scatters.
///
/// Model   The lens scatters the share s of the light, symmetrically about its direction. The
///         scattered share per steradian at angle t is C (1 + (t / core)^2)^(-slope / 2). C makes
///         the integral within 1 rad equal to 1. Slope 2 is the law of Stiles and Holladay. s is
///         about the veiling glare index, 1 to 3 % for photographic lenses.
/// Source  Stiles and Holladay's E / t^2: Vos 1984, "Disability glare - a state of the art report";
///         index: ISO 9358; the form: Harvey 1976, "Light-scattering characteristics of optical
///         surfaces".
class ScatterLaw {
 public:
  explicit ScatterLaw(const GlareModel& model);

  /// Share of the scattered light per steradian.
  double At(double angle_rad) const;

 private:
  double core_rad_, power_, scale_;
};

/// Veiling glare: light that the lens scatters from each image region to all others.
///
/// Model   ScatterLaw spreads the share s of the light of each pixel. The whole image uses the
///         angular scale on the axis. The surroundings of the image have its mean luminance. The
///         convolution runs on a coarser image, whose pixels are at most as large as the core of
///         the law.
/// Omits   The off-axis angular scale of wide lenses.
class PictureGlare {
 public:
  PictureGlare(const GlareModel& model, const CameraIntrinsics& camera);

  /// Adds the scattered light of `sources` to the unscattered light of `picture`.
  void Apply(const Image<float>& sources, Image<float>* picture) const;

 private:
  GlareModel model_;
  int coarser_, width_, height_;           ///< size of the coarser image
  int padded_width_, padded_height_;       ///< size of its padded transform
  std::vector<float> spectrum_, covered_;  ///< spectrum of the kernel; its sum over the image
};

/// Adds the scattered light of a small bright source in the direction `to_source_C`. The source
/// illuminates a plane that faces it in front of the lens with `illuminance_lx`.
void AddSourceGlare(const GlareModel& model, const std::vector<Vec3>& rays_C,
                    const Vec3& to_source_C, const Vec3& illuminance_lx, Image<float>* picture);

}  // namespace tera
