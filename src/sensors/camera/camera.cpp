#include "sensors/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/units.h"
#include "sensors/camera/dust_sight.h"
#include "sensors/camera/object_light.h"
#include "sensors/camera/pixel_noise.h"

namespace tera {
namespace {

void LimitDepth(const CameraModel& model, Workers* workers, Image<float>* depth_m) {
  constexpr std::size_t kLeastOfThread = 1 << 16;
  workers->ForRanges(depth_m->data.size(), kLeastOfThread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float& z_m = depth_m->data[i];
      if (!(z_m >= model.depth_min_m && z_m <= model.depth_max_m)) z_m = 0;
    }
  });
}

/// Soiling label of clean glass.
Image<std::uint8_t> AllClear(const CameraIntrinsics& camera) {
  Image<std::uint8_t> label(camera.width_px, camera.height_px);
  std::ranges::fill(label.data, PixelOfShare(1));
  return label;
}

}  // namespace

Pose OpticalInSensor() {
  Mat3 R_SC;
  R_SC.col(0) = -Vec3::UnitY();
  R_SC.col(1) = -Vec3::UnitZ();
  R_SC.col(2) = Vec3::UnitX();
  return MakePose(Vec3::Zero(), R_SC);
}

Camera::Camera(const CameraModel& model, const SampleClock& clock, TimeNs latency_ns,
               std::uint64_t seed, const std::string& stream_name)
    : model_(model),
      clock_(clock),
      latency_ns_(latency_ns),
      depth_noise_(seed, stream_name + "/depth"),
      rgb_noise_(seed, stream_name + "/rgb"),
      surface_labels_(model.intrinsics, model.labels) {
  if (model.stereo) {
    stereo_.emplace(*model.stereo, model.intrinsics, model.baseline_m, seed, stream_name);
  }
  if (model.time_of_flight) {
    time_of_flight_.emplace(*model.time_of_flight, model.intrinsics, seed, stream_name);
  }
  if (!model.image_sensor) return;
  const ImageSensorModel& sensor = *model.image_sensor;
  image_sensor_.emplace(sensor, model.intrinsics, seed, stream_name);
  if (model.optics) {
    optics_.emplace(*model.optics, model.intrinsics, sensor.f_number, sensor.pixel_um, seed,
                    stream_name);
  }
  if (model.object_labels.exposure) rays_.emplace(model.intrinsics);
  control_.emplace(sensor.auto_exposure, sensor.auto_white_balance, image_sensor_->UsualSettings());
}

TimeNs Camera::Reach() const {
  if (!model_.image_sensor || !model_.image_sensor->shutter) return 0;
  const ImageSensorModel& sensor = *model_.image_sensor;
  return FromSeconds(Exposures::Reach_s(*sensor.shutter, LongestExposure_s(sensor)));
}

CameraFrame Camera::See(const SceneAt& scene_at, TimeNs t_ns, Rasterizer* rasterizer,
                        const Beside& beside) const {
  const auto exposed_at = [&](TimeNs at_ns) {
    SeenScene seen = scene_at(at_ns);
    if (control_) seen.state.exposure_s = control_->Settings().exposure_s;
    return seen;
  };
  if (beside.luminance != nullptr && model_.image_sensor->shutter) {
    const double exposure_s = control_->Settings().exposure_s;
    return Sweep(
        {*model_.image_sensor->shutter, exposure_s, model_.intrinsics, model_.labels, exposed_at},
        t_ns, rasterizer, beside.luminance, beside.body, beside.light);
  }
  const SeenScene seen = exposed_at(t_ns);
  return rasterizer->Render(model_.intrinsics, seen.X_WC, seen.state, model_.labels,
                            beside.luminance, beside.body, beside.light);
}

void Camera::Label(const SceneAt& scene_at, const Rasterizer& rasterizer, const Beside& beside,
                   CameraFrame* frame) {
  if (surface_labels_.any()) {
    surface_labels_.Fill(scene_at(frame->t_ns), frame->depth_m, *beside.body, frame);
  }
  if (model_.object_labels.load) {
    load_labels_.Fill(rasterizer.model(), scene_at(frame->t_ns).state, frame);
  }
  if (model_.labels[kLensSoilingChannel]) {
    frame->lens_soiling = optics_ ? optics_->SoilingLabel() : AllClear(model_.intrinsics);
  }
  if (!model_.object_labels.exposure) return;
  const ImageSensorModel& sensor = *model_.image_sensor;
  const PictureSettings settings = control_->Settings();
  frame->exposure = {settings.exposure_s, sensor.f_number, settings.gain_db,
                     image_sensor_->white_cdpm2(settings), settings.balance};
  const bool blurs = sensor.shutter && sensor.shutter->motion_blur;
  FillObjectLight(
      *rays_,
      {rasterizer.model(), frame->depth_m, *beside.body, beside.luminance->cdpm2, *beside.light},
      scene_at, frame->t_ns, blurs ? settings.exposure_s : 0, frame);
}

Image<float> Camera::Dust(const SceneAt& scene_at, TimeNs t_ns, const Rasterizer& rasterizer,
                          const Image<float>& depth_m) {
  const bool is_dusty = rasterizer.model().environment.weather.dust.has_value();
  if (!model_.labels[kDustChannel] && !(is_dusty && model_.depth)) return {};
  if (!rays_) rays_.emplace(model_.intrinsics);
  return DustOpticalDepths(*rays_, scene_at(t_ns), depth_m);
}

Image<float> Camera::Air(const Rasterizer& rasterizer, Image<float> dust,
                         const Image<float>& depth_m) {
  const double extinction_1pm = rasterizer.model().environment.weather.Extinction_1pm();
  if (extinction_1pm <= 0) return dust;
  if (!rays_) rays_.emplace(model_.intrinsics);
  return AirOpticalDepths(*rays_, extinction_1pm, std::move(dust), depth_m);
}

Image<float> Camera::Range(std::int64_t k, const SceneAt& scene_at, const Image<float>& air,
                           Image<float> depth_m, Rasterizer* rasterizer) const {
  if (stereo_) return stereo_->Measure(k, scene_at(clock_.Due(k)), rasterizer);
  if (time_of_flight_) return time_of_flight_->Measure(k, scene_at(clock_.Due(k)), rasterizer);
  if (model_.disparity_noise_px > 0) {
    const auto first = static_cast<std::uint64_t>(k) * depth_m.data.size();
    const double scale_1pm =
        model_.disparity_noise_px / (model_.intrinsics.fx_px * model_.baseline_m);
    AddDisparityNoise(scale_1pm, depth_noise_, first, air, rasterizer->workers(), &depth_m);
  }
  return depth_m;
}

Image<std::uint8_t> Camera::Sense(const Image<float>& luminance_cdpm2, std::int64_t k) {
  const PictureSettings settings = control_->Settings();
  const Image<std::uint16_t> raw_dn = image_sensor_->Expose(luminance_cdpm2, k, settings);
  const ImageSensorModel& sensor = *model_.image_sensor;
  Metered for_exposure, for_balance;
  if (sensor.auto_exposure) {
    for_exposure = image_sensor_->Meter(raw_dn, sensor.auto_exposure->zone);
  }
  if (sensor.auto_white_balance) {
    for_balance = image_sensor_->Meter(raw_dn, sensor.auto_white_balance->zone);
  }
  control_->Take(for_exposure, for_balance);
  return image_sensor_->Develop(raw_dn, settings);
}

CameraFrame Camera::Measure(std::int64_t k, const Pose& X_WS, const SceneState& scene,
                            Rasterizer* rasterizer) {
  return Measure(
      k,
      [&](TimeNs) {
        return SeenScene{X_WS * OpticalInSensor(), scene};
      },
      rasterizer);
}

CameraFrame Camera::Measure(std::int64_t k, const SceneAt& scene_at, Rasterizer* rasterizer) {
  LuminancePicture luminance;
  if (image_sensor_) luminance.white_cdpm2 = image_sensor_->white_cdpm2(control_->Settings());
  Image<std::uint16_t> body;
  Image<float> light;
  const bool needs_light = model_.object_labels.exposure;
  const bool needs_bodies = surface_labels_.any() || needs_light;
  const Beside beside{image_sensor_ ? &luminance : nullptr, needs_bodies ? &body : nullptr,
                      needs_light ? &light : nullptr};
  CameraFrame frame = See(scene_at, clock_.Due(k), rasterizer, beside);
  frame.t_ns = clock_.Due(k);
  Label(scene_at, *rasterizer, beside, &frame);
  Image<float> dust = Dust(scene_at, frame.t_ns, *rasterizer, frame.depth_m);
  if (!dust.empty()) frame.dust_optical_depth = DustLabel(dust);
  if (optics_) {
    optics_->Apply(scene_at(frame.t_ns), frame.depth_m, rasterizer, &luminance.cdpm2);
  }
  frame.t_available_ns = frame.t_ns + Reach() + latency_ns_;
  if (!model_.rgb) {
    frame.rgb = {};
  } else if (image_sensor_) {
    frame.rgb = Sense(luminance.cdpm2, k);
  } else if (model_.rgb_noise > 0) {
    AddRgbNoise(model_.rgb_noise, rgb_noise_,
                static_cast<std::uint64_t>(k) * frame.rgb.data.size() / 3, rasterizer->workers(),
                &frame.rgb);
  }
  if (!model_.depth) {
    frame.depth_m = {};
  } else {
    const Image<float> air = Air(*rasterizer, std::move(dust), frame.depth_m);
    frame.depth_m = Range(k, scene_at, air, std::move(frame.depth_m), rasterizer);
    if (!air.empty()) LoseDepthInAir(air, &frame.depth_m);
    LimitDepth(model_, rasterizer->workers(), &frame.depth_m);
  }
  ForEachLabel(frame, [&](const LabelChannel& channel, auto& picture) {
    if (!model_.labels[IndexOf(channel)]) picture = {};
  });
  if (!model_.labels[kInstanceChannel]) frame.boxes.clear();
  return frame;
}

}  // namespace tera
