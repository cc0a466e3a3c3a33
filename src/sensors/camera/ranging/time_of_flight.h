#pragma once

#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// A camera that measures distance by the phase of its modulated light.
struct TimeOfFlightModel {
  double frequency_hz = 20e6;
  int parts = 3;          ///< parts of a pixel per axis, whose light mixes
  bool multipath = true;  ///< light after one diffuse bounce
  double noise = 3e-4;    ///< 1 sigma of each phasor component, relative to a white surface that
                          ///< faces the camera at 1 m
  double least_signal = 0.0;  ///< minimum signal of a measurement, in the same unit
};

void Serialize(ModelArchive* archive, TimeOfFlightModel* model);

/// A surface patch that the camera illuminates and sees, in C.
struct LitPatch {
  Vec3 p_C_m = Vec3::Zero();  ///< zero: no surface
  Vec3 normal_C = Vec3::Zero();
  double reflectance = 0;  ///< 0 to 1, diffuse
  double area_m2 = 0;

  bool exists() const { return reflectance > 0 && !p_C_m.isZero(); }
};

/// Modulated light: the modulus is its strength, the argument its phase.
using Phasor = std::complex<double>;

/// Direct light from a patch, relative to a white patch facing the camera at 1 m: rho cos / r^2,
/// with the phase of the path 2 r.
Phasor DirectLight(const LitPatch& patch, double frequency_hz);
/// Light on a point after a bounce off each other patch, in the same unit. The result excludes the
/// point's own reflectance and its distance r to the camera.
Phasor LightOver(const std::vector<LitPatch>& others, const LitPatch& at, double frequency_hz);

/// Depth by time of flight.
///
/// Frames  eye and light source coincide in C; depth as in CameraIntrinsics.
/// Model   each pixel adds the phasors of its parts, rho cos(theta) / r^2 at the phase
///         4 pi f r / c. Distances therefore mix at edges ("flying pixels"). Multipath adds the
///         light that patches of a coarse grid reflect onto the pixel's surface, delayed by its
///         longer path. Corners therefore appear too far and rounded. Distance is c phase / (4 pi
///         f), modulo the ambiguity range. Both components of a phasor have noise. Reflectance is
///         luminance times pi over illuminance, from scene light. Fog, rain and falling snow dim
///         the camera's light by exp(-2 tau). They add back-scattered light from beyond 0.1 m: the
///         integral of pi b exp(-2 a r) / r^2 dr, with extinction a and back-scatter b.
/// Omits   light after several bounces, mirrors, scattering in the lens, dimming by dust, the
///         distance between eye and lamp, motion within a measurement, background light, wiggling
///         of the correlation.
/// Source  Hansard, Lee, Choi and Horaud 2012, "Time-of-flight cameras: principles, methods and
///         applications", eqs. (1.1) to (1.12); one bounce: Fuchs 2010, "Multipath interference
///         compensation in time-of-flight camera images".
class TimeOfFlight {
 public:
  TimeOfFlight(const TimeOfFlightModel& model, const CameraIntrinsics& camera, std::uint64_t seed,
               const std::string& stream_name);

  /// Depth of image k.
  Image<float> Measure(std::int64_t k, const SeenScene& scene, Rasterizer* rasterizer) const;

  static constexpr int kPatches = 24;  ///< patches along the image's longer side

 private:
  /// Surface patch of each part of each pixel.
  std::vector<LitPatch> PartsOf(const SeenScene& scene, Rasterizer* rasterizer) const;
  /// The coarse grid: each patch uses its middle part, with the area that its cell covers.
  std::vector<LitPatch> PatchesOf(const std::vector<LitPatch>& parts) const;

  TimeOfFlightModel model_;
  CameraIntrinsics camera_, finer_;
  int cell_px_;  ///< side of a coarse cell, in pixels
  Stream noise_;
};

}  // namespace tera
