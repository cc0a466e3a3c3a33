#include "sensors/camera/camera.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"
#include "core/config/spelling.h"
#include "core/units.h"
#include "sensors/camera/dust_sight.h"
#include "sensors/camera/pixel_noise.h"
#include "sensors/camera/read_lens.h"

namespace tera {
namespace {

constexpr float kMaxValue = 255.0f;

LabelSet ReadLabelSet(const ConfigMap& config) {
  std::vector<std::string> known;
  for (const LabelChannel& channel : kLabelChannels) known.emplace_back(channel.name);
  LabelSet labels;
  if (config.IsText("labels") && std::ranges::count(known, config.Text("labels")) > 0) {
    config.Fault("labels", fmt::format("is a channel's name alone; need a list, [{}], or true or "
                                       "false",
                                       config.Text("labels")));
    return labels;
  }
  if (!config.IsList("labels")) return config.Boolean("labels", true) ? UsualLabels() : labels;
  for (const std::string& name : config.Texts("labels")) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      config.Fault("labels", fmt::format("'{}' is no label channel{}; need some of {}, or true or "
                                         "false",
                                         name, DidYouMean(name, known), fmt::join(known, ", ")));
    } else {
      labels.set(static_cast<std::size_t>(found - known.begin()));
    }
  }
  return labels;
}

/// Labels that are computed from depth and poses need all rows to be of one instant.
void CheckLabelsUnderShutter(const ConfigMap& config, const CameraModel& model) {
  if (!model.image_sensor->shutter || model.image_sensor->shutter->readout_s == 0) return;
  for (const LabelChannel& channel : kLabelChannels) {
    const bool is_of_an_instant =
        channel.source == LabelSource::kSurfaces || channel.source == LabelSource::kAir;
    if (!model.labels[IndexOf(channel)] || !is_of_an_instant) continue;
    config.Fault("labels", fmt::format("'{}' is of one instant, but image_sensor.shutter reads the "
                                       "rows one after the other; need readout_s: 0, or to leave "
                                       "it out",
                                       channel.name));
  }
}

void LimitDepth(const CameraModel& model, Image<float>* depth_m) {
  for (float& z_m : depth_m->data) {
    if (!(z_m >= model.depth_min_m && z_m <= model.depth_max_m)) z_m = 0;
  }
}

}  // namespace

std::string LabelsYaml(LabelSet labels) {
  if (labels == UsualLabels() || labels.none()) return labels.any() ? "true" : "false";
  std::vector<std::string_view> names;
  for (const LabelChannel& channel : kLabelChannels) {
    if (labels[IndexOf(channel)]) names.push_back(channel.name);
  }
  return fmt::format("[{}]", fmt::join(names, ", "));
}

CameraModel ReadCameraModel(const ConfigMap& config) {
  CameraModel m;
  m.intrinsics = ReadLens(config);
  m.rgb = config.Boolean("rgb", m.rgb);
  m.depth = config.Boolean("depth", m.depth);
  m.labels = ReadLabelSet(config);
  if (!m.rgb && !m.depth && m.labels.none()) {
    config.Fault("rgb", "rgb, depth and labels are all off; switch one on");
  }
  m.depth_min_m = config.Number("depth_min_m", AtLeast(0, "m"), m.depth_min_m);
  m.depth_max_m = config.Number("depth_max_m", Positive("m"), m.depth_max_m);
  if (m.depth_max_m <= m.depth_min_m) {
    config.Fault("depth_max_m", "not beyond depth_min_m; need depth_min_m < depth_max_m");
  }
  m.disparity_noise_px = config.Number("disparity_noise_px", AtLeast(0, "px"), 0);
  m.baseline_m = config.Number("baseline_m", Positive("m"), m.baseline_m);
  m.rgb_noise = config.Number("rgb_noise", Between(0, kMaxValue, "of 255"), 0);
  if (const auto sensor = config.OptionalMap("image_sensor")) {
    m.image_sensor = ReadImageSensor(*sensor);
    if (m.rgb_noise > 0) {
      config.Fault("rgb_noise", "given beside image_sensor, which has noise of its own; keep one");
    }
    if (!m.rgb) config.Fault("image_sensor", "makes colour, which is off; need rgb: true");
    CheckLabelsUnderShutter(config, m);
  }
  return m;
}

std::string CameraModelYaml(const CameraModel& m) {
  const std::string text =
      LensYaml(m.intrinsics) +
      fmt::format(
          "  rgb: {}\n  depth: {}\n  labels: {}\n  depth_min_m: {}\n  depth_max_m: {}\n"
          "  disparity_noise_px: {}\n  baseline_m: {}\n  rgb_noise: {}\n",
          m.rgb, m.depth, LabelsYaml(m.labels), m.depth_min_m, m.depth_max_m, m.disparity_noise_px,
          m.baseline_m, m.rgb_noise);
  return m.image_sensor ? text + "  image_sensor:\n" + ImageSensorYaml(*m.image_sensor) : text;
}

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
  if (!model.image_sensor) return;
  const ImageSensorModel& sensor = *model.image_sensor;
  image_sensor_.emplace(sensor, model.intrinsics, seed, stream_name);
  control_.emplace(sensor.auto_exposure, sensor.auto_white_balance, image_sensor_->UsualSettings());
}

TimeNs Camera::Reach() const {
  if (!model_.image_sensor || !model_.image_sensor->shutter) return 0;
  const ImageSensorModel& sensor = *model_.image_sensor;
  return FromSeconds(Exposures::Reach_s(*sensor.shutter, LongestExposure_s(sensor)));
}

CameraFrame Camera::See(const SceneAt& scene_at, TimeNs t_ns, Rasterizer* rasterizer,
                        LuminancePicture* luminance, Image<std::uint16_t>* body) const {
  const auto exposed_at = [&](TimeNs at_ns) {
    SeenScene seen = scene_at(at_ns);
    if (control_) seen.state.exposure_s = control_->Settings().exposure_s;
    return seen;
  };
  if (luminance != nullptr && model_.image_sensor->shutter) {
    const double exposure_s = control_->Settings().exposure_s;
    return Sweep(
        {*model_.image_sensor->shutter, exposure_s, model_.intrinsics, model_.labels, exposed_at},
        t_ns, rasterizer, luminance, body);
  }
  const SeenScene seen = exposed_at(t_ns);
  return rasterizer->Render(model_.intrinsics, seen.X_WC, seen.state, model_.labels, luminance,
                            body);
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
  CameraFrame frame = See(scene_at, clock_.Due(k), rasterizer, image_sensor_ ? &luminance : nullptr,
                          surface_labels_.any() ? &body : nullptr);
  frame.t_ns = clock_.Due(k);
  if (surface_labels_.any()) {
    surface_labels_.Fill(scene_at(clock_.Due(k)), frame.depth_m, body, &frame);
  }
  Image<float> dust;
  const bool is_dusty = rasterizer->model().environment.weather.dust.has_value();
  if (model_.labels[kDustChannel] || (is_dusty && model_.depth)) {
    if (!rays_) rays_.emplace(model_.intrinsics);
    dust = DustOpticalDepths(*rays_, scene_at(clock_.Due(k)), frame.depth_m);
  }
  if (!dust.empty()) frame.dust_optical_depth = DustLabel(dust);
  frame.t_available_ns = frame.t_ns + Reach() + latency_ns_;
  const auto exposure = static_cast<std::uint64_t>(k);
  if (!model_.rgb) {
    frame.rgb = {};
  } else if (image_sensor_) {
    frame.rgb = Sense(luminance.cdpm2, k);
  } else if (model_.rgb_noise > 0) {
    AddRgbNoise(model_.rgb_noise, rgb_noise_, exposure * frame.rgb.data.size() / 3, &frame.rgb);
  }
  if (!model_.depth) {
    frame.depth_m = {};
  } else {
    if (model_.disparity_noise_px > 0) {
      const double scale_1pm =
          model_.disparity_noise_px / (model_.intrinsics.fx_px * model_.baseline_m);
      AddDisparityNoise(scale_1pm, depth_noise_, exposure * frame.depth_m.data.size(), dust,
                        &frame.depth_m);
    }
    if (!dust.empty()) LoseDepthInDust(dust, &frame.depth_m);
    LimitDepth(model_, &frame.depth_m);
  }
  ForEachLabel(frame, [&](const LabelChannel& channel, auto& picture) {
    if (!model_.labels[IndexOf(channel)]) picture = {};
  });
  if (!model_.labels[kInstanceChannel]) frame.boxes.clear();
  return frame;
}

}  // namespace tera
