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
  int parts = 3;          ///< parts of a pixel per axis, whose light is added
  bool multipath = true;  ///< includes light after one diffuse bounce
  /// Standard deviation of each component of the phasor, relative to a white surface that faces the
  /// camera at 1 m.
  double noise = 3e-4;
  double least_signal = 0.0;  ///< least signal of a measurement, in the same unit
};

void Serialize(ModelArchive* archive, TimeOfFlightModel* model);

/// A surface patch that the camera lights and sees, in C.
struct LitPatch {
  Vec3 p_C_m = Vec3::Zero();  ///< zero if there is no surface
  Vec3 normal_C = Vec3::Zero();
  double reflectance = 0;  ///< 0 to 1, diffuse
  double area_m2 = 0;

  bool exists() const { return reflectance > 0 && !p_C_m.isZero(); }
};

/// Modulated light: its modulus is the strength, its argument the phase.
using Phasor = std::complex<double>;

/// Direct light from a patch, relative to a white patch that faces the camera at 1 m: rho cos /
/// r^2, with the phase of the path 2 r.
Phasor DirectLight(const LitPatch& patch, double frequency_hz);
/// Light on a point after one bounce off each other patch, in the same unit. Excludes the
/// reflectance of the point and its distance to the camera.
Phasor LightOver(const std::vector<LitPatch>& others, const LitPatch& at, double frequency_hz);

/// Depth by time of flight.
///
/// Frames  Eye and light source coincide in C; depth as in CameraIntrinsics.
/// Model   Direct light: each pixel adds the phasors of its parts, rho cos(theta) / r^2 at the
///         phase 4 pi f r / c. So distances mix at edges ("flying pixels"). Distance is c phase /
///         (4 pi f), modulo the ambiguity range. Both components of a phasor have noise. The
///         reflectance is luminance times pi over illuminance, from scene light.
///         Multipath: the patches of a coarse grid reflect light onto the surface of a pixel,
///         delayed by the longer path. So corners appear too far and rounded.
///         Air: fog, rain and falling snow reduce the camera's light by exp(-2 tau). From beyond
///         0.1 m they add back-scattered light: the integral of pi b exp(-2 a r) / r^2 dr, with
///         extinction a and back-scatter b.
/// Omits   Several bounces, mirrors, scattering in the lens, extinction by dust, the distance
///         between eye and lamp, motion within a measurement, background light, periodic error of
///         the correlation.
/// Source  Hansard, Lee, Choi and Horaud 2012, "Time-of-flight cameras: principles, methods and
///         applications", eqs. (1.1) to (1.12); one bounce: Fuchs 2010, "Multipath interference
///         compensation in time-of-flight camera images".
class TimeOfFlight {
 public:
  TimeOfFlight(const TimeOfFlightModel& model, const CameraIntrinsics& camera, std::uint64_t seed,
               const std::string& stream_name);

  /// Depth of image k.
  Image<float> Measure(std::int64_t k, const SeenScene& scene, Rasterizer* rasterizer) const;

  static constexpr int kPatches = 24;  ///< patches along the longer side of the image

 private:
  /// Surface patch of each part of each pixel.
  std::vector<LitPatch> PartsOf(const SeenScene& scene, Rasterizer* rasterizer) const;
  /// The coarse grid: each patch is the middle part of its cell, with the area that the cell
  /// covers.
  std::vector<LitPatch> PatchesOf(const std::vector<LitPatch>& parts) const;

  TimeOfFlightModel model_;
  CameraIntrinsics camera_, finer_;
  int cell_px_;  ///< side of a coarse cell, in pixels
  Stream noise_;
};

}  // namespace tera
