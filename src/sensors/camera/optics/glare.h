#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "sensors/camera/optics/optics_model.h"

namespace tera {

/// How a lens scatters light from one direction into others.
///
/// Model   of the light s is scattered, evenly about its direction: per steradian at the angle t
///         C (1 + (t / core)^2)^(-slope / 2), C such that all of it arrives within 1 rad. Slope 2
///         is the law of Stiles and Holladay; s is about the veiling glare index, 1 to 3 % of
///         lenses for photography.
/// Source  Stiles and Holladay's E / t^2: Vos 1984, "Disability glare - a state of the art report";
///         index: ISO 9358; the form: Harvey 1976, "Light-scattering characteristics of optical
///         surfaces".
class ScatterLaw {
 public:
  explicit ScatterLaw(const GlareModel& model);

  /// Of the scattered light, per steradian.
  double At(double angle_rad) const;

 private:
  double core_rad_, power_, scale_;
};

/// Light in a picture that its lens scatters from one part over the others.
///
/// Model   a share s of each pixel's light is spread by ScatterLaw, angles being those about the
///         axis for all of the picture. What comes from beyond its borders is as bright as its
///         mean. Found on a coarser picture, of which a pixel is no larger than the law's core.
/// Omits   of wide lenses how far apart directions are off the axis.
class PictureGlare {
 public:
  PictureGlare(const GlareModel& model, const CameraIntrinsics& camera);

  /// `sources` is what scatters; what is left of `picture` and what comes to it is put together.
  void Apply(const Image<float>& sources, Image<float>* picture) const;

 private:
  GlareModel model_;
  int coarser_, width_, height_;           ///< of the coarser picture
  int padded_width_, padded_height_;       ///< for its transform
  std::vector<float> spectrum_, covered_;  ///< of the kernel; its sum over the picture, by pixel
};

/// Adds what the lens scatters of a small bright source at `to_source_C`, which lights a plane
/// before the lens that faces it with `illuminance_lx`.
void AddSourceGlare(const GlareModel& model, const std::vector<Vec3>& rays_C,
                    const Vec3& to_source_C, const Vec3& illuminance_lx, Image<float>* picture);

}  // namespace tera
