#include "sensors/camera/ranging/time_of_flight.h"

#include <algorithm>
#include <cmath>

#include "core/types/surface_normal.h"
#include "core/units.h"
#include "render/air/rain.h"
#include "render/air/weather.h"
#include "sensors/camera/ranging/dot_projector.h"

namespace tera {
namespace {

constexpr double kLight_mps = 299792458;
constexpr double kDarkest_lx = 1e-4;  // scene light below which the reflectance is unknown

/// Phase of light after a path.
Phasor After(double way_m, double frequency_hz) {
  return std::polar(1.0, 2 * kPi * frequency_hz * way_m / kLight_mps);
}

/// Extinction and back-scatter of the camera's own light in the air.
struct LitAir {
  double extinction_1pm;
  Phasor scattered;  ///< light returned by the air, in the unit of DirectLight

  double TwoWay(double range_m) const { return std::exp(-2 * extinction_1pm * range_m); }
};

LitAir LitAirOf(const Weather& weather, double frequency_hz) {
  // nearer, the beam of the lamp is outside the field of the eye
  constexpr double kNearest_m = 0.1;
  constexpr double kGrowth = 1.02;  // growth factor of the steps
  constexpr double kFarthest_m = 50;
  const double fog_1pm = FogExtinction_1pm(weather.visibility_m);
  const double rain_1pm = Rain(weather.rain_mmph).Extinction_1pm();
  const double snow_1pm = Snowfall(weather.snowfall_mmph).Extinction_1pm();
  const double back_1pmsr = FogBackscatter_1pmsr(fog_1pm) + rain_1pm / Rain::kLidarRatio_sr +
                            snow_1pm / Snowfall::kLidarRatio_sr;
  LitAir air{fog_1pm + rain_1pm + snow_1pm, 0};
  if (air.extinction_1pm <= 0) return air;
  for (double r_m = kNearest_m; r_m < kFarthest_m; r_m *= kGrowth) {
    const double middle_m = r_m * std::sqrt(kGrowth), step_m = r_m * (kGrowth - 1);
    air.scattered += kPi * back_1pmsr * step_m * air.TwoWay(middle_m) / (middle_m * middle_m) *
                     After(2 * middle_m, frequency_hz);
  }
  return air;
}

double CosineTo(const LitPatch& patch, const Vec3& to_C) {
  return std::max(0.0, patch.normal_C.dot(to_C.normalized()));
}

/// The same lens with `times` the resolution.
CameraIntrinsics Finer(const CameraIntrinsics& lens, int times) {
  CameraIntrinsics finer = lens;
  finer.width_px *= times;
  finer.height_px *= times;
  finer.fx_px *= times;
  finer.fy_px *= times;
  finer.cx_px = (lens.cx_px + 0.5) * times - 0.5;
  finer.cy_px = (lens.cy_px + 0.5) * times - 0.5;
  return finer;
}

}  // namespace

void Serialize(ModelArchive* archive, TimeOfFlightModel* m) {
  archive->Visit("frequency_hz", &m->frequency_hz, Between(1e5, 1e9, "Hz"));
  archive->Visit("parts", &m->parts, Between(1, 8, ""));
  archive->Visit("multipath", &m->multipath);
  archive->Visit("noise", &m->noise, AtLeast(0, "1"));
  archive->Visit("least_signal", &m->least_signal, AtLeast(0, "1"));
}

Phasor DirectLight(const LitPatch& patch, double frequency_hz) {
  const double r_m = patch.p_C_m.norm();
  return patch.reflectance * CosineTo(patch, -patch.p_C_m) / (r_m * r_m) *
         After(2 * r_m, frequency_hz);
}

Phasor LightOver(const std::vector<LitPatch>& others, const LitPatch& at, double frequency_hz) {
  Phasor sum = 0;
  for (const LitPatch& other : others) {
    const Vec3 way_C_m = at.p_C_m - other.p_C_m;
    const double d_m = way_C_m.norm();
    // A near patch counts as a disc of its area, so that it passes on at most its total emission.
    if (!other.exists() || !(d_m > 0)) continue;
    const double r_m = other.p_C_m.norm();
    const double lit = CosineTo(other, -other.p_C_m) / (r_m * r_m);
    const double exchange = CosineTo(other, way_C_m) * CosineTo(at, -way_C_m) * other.area_m2 /
                            (kPi * d_m * d_m + other.area_m2);
    sum += other.reflectance * lit * exchange * After(r_m + d_m, frequency_hz);
  }
  return sum;
}

TimeOfFlight::TimeOfFlight(const TimeOfFlightModel& model, const CameraIntrinsics& camera,
                           std::uint64_t seed, const std::string& stream_name)
    : model_(model),
      camera_(camera),
      finer_(Finer(camera, model.parts)),
      cell_px_(std::max(1, std::max(camera.width_px, camera.height_px) / kPatches)),
      noise_(seed, stream_name + "/time_of_flight") {}

std::vector<LitPatch> TimeOfFlight::PartsOf(const SeenScene& scene, Rasterizer* rasterizer) const {
  LabelSet labels;
  labels.set(kNormalChannel);
  LuminancePicture luminance{.white_cdpm2 = MeteredWhite_cdpm2(*rasterizer), .cdpm2 = {}};
  Image<float> light;
  const CameraFrame frame =
      rasterizer->Render(finer_, scene.X_WC, scene.state, labels, &luminance, nullptr, &light);
  std::vector<LitPatch> parts(frame.depth_m.data.size());
  for (int y = 0; y < finer_.height_px; ++y) {
    for (int x = 0; x < finer_.width_px; ++x) {
      const double depth_m = double(frame.depth_m.at(x, y)), lux = double(light.at(x, y, 0));
      const auto normal_C = NormalAt(frame.normal, x, y);
      if (!(depth_m > 0) || !normal_C || lux < kDarkest_lx) continue;
      LitPatch& part = parts[static_cast<std::size_t>(y) * finer_.width_px + x];
      part.p_C_m = depth_m * finer_.Unproject(Vec2(x, y));
      part.normal_C = *normal_C;
      const double cdpm2 = 0.2126 * double(luminance.cdpm2.at(x, y, 0)) +
                           0.7152 * double(luminance.cdpm2.at(x, y, 1)) +
                           0.0722 * double(luminance.cdpm2.at(x, y, 2));
      part.reflectance = std::clamp(kPi * cdpm2 / lux, 0.0, 1.0);
    }
  }
  return parts;
}

std::vector<LitPatch> TimeOfFlight::PatchesOf(const std::vector<LitPatch>& parts) const {
  std::vector<LitPatch> patches;
  for (int y = 0; y < camera_.height_px; y += cell_px_) {
    for (int x = 0; x < camera_.width_px; x += cell_px_) {
      const int wide_px = std::min(cell_px_, camera_.width_px - x);
      const int high_px = std::min(cell_px_, camera_.height_px - y);
      const int u = (2 * x + wide_px) * model_.parts / 2, v = (2 * y + high_px) * model_.parts / 2;
      LitPatch patch = parts[static_cast<std::size_t>(v) * finer_.width_px + u];
      if (!patch.exists()) continue;
      // A cell of the image covers the area dx dy z^3 / (f^2 r) of a plane that faces the camera.
      const double z_m = patch.p_C_m.z(), r_m = patch.p_C_m.norm();
      const double facing = CosineTo(patch, -patch.p_C_m);
      if (facing < 0.05) continue;  // nearly edge-on
      patch.area_m2 =
          wide_px * high_px * z_m * z_m * z_m / (camera_.fx_px * camera_.fy_px * r_m * facing);
      patches.push_back(patch);
    }
  }
  return patches;
}

Image<float> TimeOfFlight::Measure(std::int64_t k, const SeenScene& scene,
                                   Rasterizer* rasterizer) const {
  const std::vector<LitPatch> parts = PartsOf(scene, rasterizer);
  const std::vector<LitPatch> patches =
      model_.multipath ? PatchesOf(parts) : std::vector<LitPatch>{};
  const double f_hz = model_.frequency_hz;
  const LitAir air = LitAirOf(rasterizer->model().environment.weather, f_hz);
  Image<float> depth_m(camera_.width_px, camera_.height_px);
  const auto first = static_cast<std::uint64_t>(k) * depth_m.data.size();
  for (int y = 0; y < camera_.height_px; ++y) {
    for (int x = 0; x < camera_.width_px; ++x) {
      Phasor sum = 0;
      for (int j = 0; j < model_.parts * model_.parts; ++j) {
        const int u = x * model_.parts + j % model_.parts, v = y * model_.parts + j / model_.parts;
        const LitPatch& part = parts[static_cast<std::size_t>(v) * finer_.width_px + u];
        if (part.exists()) sum += air.TwoWay(part.p_C_m.norm()) * DirectLight(part, f_hz);
      }
      sum /= model_.parts * model_.parts;
      const int middle = model_.parts / 2;
      const LitPatch& at =
          parts[static_cast<std::size_t>(y * model_.parts + middle) * finer_.width_px +
                x * model_.parts + middle];
      if (model_.multipath && at.exists()) {
        sum += air.TwoWay(at.p_C_m.norm()) * at.reflectance * LightOver(patches, at, f_hz) *
               After(at.p_C_m.norm(), f_hz);
      }
      sum += air.scattered;
      const std::uint64_t pixel = first + static_cast<std::uint64_t>(y) * camera_.width_px + x;
      if (model_.noise > 0 && sum != Phasor(0)) {
        sum += model_.noise * Phasor(noise_.Gaussian(pixel, 0), noise_.Gaussian(pixel, 1));
      }
      if (!(std::abs(sum) > model_.least_signal)) continue;
      double phase = std::arg(sum);
      if (phase < 0) phase += 2 * kPi;
      const double range_m = kLight_mps * phase / (4 * kPi * f_hz);
      const Vec3 ray_C = camera_.Unproject(Vec2(x, y));
      depth_m.at(x, y) = static_cast<float>(range_m / ray_C.norm());
    }
  }
  return depth_m;
}

}  // namespace tera
