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

/// A camera that measures distance by the phase of its own modulated light.
struct TimeOfFlightModel {
  double frequency_hz = 20e6;
  int parts = 3;              ///< of a pixel, either way, whose light is mixed
  bool multipath = true;      ///< light that comes over one other surface
  double noise = 3e-4;        ///< 1 sigma of each of a phasor's two numbers, over that of a white
                              ///< surface that faces the camera at 1 m
  double least_signal = 0.0;  ///< in the same measure: what is weaker is no measurement
};

void Serialize(ModelArchive* archive, TimeOfFlightModel* model);

/// A surface that the camera lights and sees, in C.
struct LitPatch {
  Vec3 p_C_m = Vec3::Zero();  ///< zero: none
  Vec3 normal_C = Vec3::Zero();
  double reflectance = 0;  ///< 0 to 1, diffuse
  double area_m2 = 0;

  bool exists() const { return reflectance > 0 && !p_C_m.isZero(); }
};

/// Of modulated light: its strength and, in the argument, its phase.
using Phasor = std::complex<double>;

/// Light that comes back from a patch directly, over that of a white one facing the camera at 1 m:
/// rho cos / r^2, with the phase of 2 r.
Phasor DirectLight(const LitPatch& patch, double frequency_hz);
/// Light on a point over one other patch each, in the same measure before the point's own
/// reflectance and without its own way r to the camera.
Phasor LightOver(const std::vector<LitPatch>& others, const LitPatch& at, double frequency_hz);

/// Depth by time of flight.
///
/// Frames  eye and light together in C, as CameraIntrinsics has depth.
/// Model   Each pixel adds the phasors of its parts, rho cos(theta) / r^2 at the phase
///         4 pi f r / c: at edges distances mix ("flying pixels"). With multipath, light that the
///         patches of a coarse grid throw on the pixel's surface comes on top, later by its longer
///         way: corners are measured too far, and round. Distance is c phase / (4 pi f), within the
///         ambiguity range, beyond which it starts at zero again. Noise is added to both numbers of
///         a phasor. Reflectance is luminance times pi over illuminance, of the scene's own light.
/// Omits   light over more than one surface, mirrors, scattering in the lens, the way between eye
///         and lamp, motion within a measurement, background light, wiggling of the correlation.
/// Source  Hansard, Lee, Choi and Horaud 2012, "Time-of-flight cameras: principles, methods and
///         applications", eqs. (1.1) to (1.12); one bounce: Fuchs 2010, "Multipath interference
///         compensation in time-of-flight camera images".
class TimeOfFlight {
 public:
  TimeOfFlight(const TimeOfFlightModel& model, const CameraIntrinsics& camera, std::uint64_t seed,
               const std::string& stream_name);

  /// Depth of picture k.
  Image<float> Measure(std::int64_t k, const SeenScene& scene, Rasterizer* rasterizer) const;

  static constexpr int kPatches = 24;  ///< of the coarse grid along the picture's longer side

 private:
  /// What each part of each pixel shows.
  std::vector<LitPatch> PartsOf(const SeenScene& scene, Rasterizer* rasterizer) const;
  /// The coarse grid: every patch is its middle part's, with the area that its cell covers.
  std::vector<LitPatch> PatchesOf(const std::vector<LitPatch>& parts) const;

  TimeOfFlightModel model_;
  CameraIntrinsics camera_, finer_;
  int cell_px_;  ///< pixels of a coarse cell's side
  Stream noise_;
};

}  // namespace tera
