#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/config/config_beneath.h"
#include "core/config/spelling.h"
#include "sensors/camera/camera.h"
#include "sensors/camera/read_lens.h"

namespace tera {
namespace {

constexpr double kMaxValue = 255;

LabelSet ReadLabelSet(const ConfigMap& config) {
  std::vector<std::string> known;
  for (const LabelChannel& channel : kLabelChannels) known.emplace_back(channel.name);
  LabelSet labels;
  if (config.IsText("labels") && std::ranges::count(known, config.Text("labels")) > 0) {
    config.Fault("labels", {FaultKind::kMistyped,
                            fmt::format("is a channel's name alone; need a list, [{}], or true or "
                                        "false",
                                        config.Text("labels"))});
    return labels;
  }
  if (!config.IsList("labels")) return config.Boolean("labels", true) ? UsualLabels() : labels;
  for (const std::string& name : config.Texts("labels")) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      config.Fault("labels", {FaultKind::kNoSuchName,
                              fmt::format("'{}' is no label channel{}; need some of {}, or true or "
                                          "false",
                                          name, DidYouMean(name, known), fmt::join(known, ", "))});
    } else {
      labels.set(static_cast<std::size_t>(found - known.begin()));
    }
  }
  return labels;
}

/// Reports labels that need a single instant under a rolling shutter: those from depth and poses.
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

/// Reads a stereo matcher or time of flight, which replaces depth with noise.
void ReadDepthSensor(const ConfigMap& config, CameraModel* model) {
  std::string_view key;
  if (const auto stereo = config.OptionalMap("stereo")) {
    key = "stereo";
    model->stereo = ReadModel<StereoModel>(*stereo);
  }
  if (const auto flight = config.OptionalMap("time_of_flight")) {
    if (model->stereo) config.Fault("time_of_flight", "given beside stereo; keep one of the two");
    key = "time_of_flight";
    model->time_of_flight = ReadModel<TimeOfFlightModel>(*flight);
  }
  // Either one replaces the noise of a preset.
  if (key.empty() || !LiesBelow(config, "disparity_noise_px", key)) {
    model->disparity_noise_px = config.Number("disparity_noise_px", AtLeast(0, "px"), 0);
  }
  if (key.empty()) return;
  if (model->disparity_noise_px > 0) {
    config.Fault("disparity_noise_px",
                 fmt::format("given beside {}, which has errors of its own; keep one", key));
  }
  if (!model->depth) config.Fault(key, "makes depth, which is off; need depth: true");
  if (model->intrinsics.Distorted()) {
    config.Fault(key,
                 "needs pictures of a pinhole, but this lens distorts; need a camera without "
                 "lens and its coefficients");
  }
  constexpr int kFinest_px = 8192;  // side of the image that renders the parts
  const int side_px = std::max(model->intrinsics.width_px, model->intrinsics.height_px);
  if (model->time_of_flight && model->time_of_flight->parts * side_px > kFinest_px) {
    config.Map("time_of_flight")
        .Fault("parts", fmt::format("{} of a picture {} px wide or high are {} px; need {} px at "
                                    "most, {} parts, or a smaller picture",
                                    model->time_of_flight->parts, side_px,
                                    model->time_of_flight->parts * side_px, kFinest_px,
                                    std::max(1, kFinest_px / side_px)));
  }
  if (model->stereo && model->stereo->disparities_px + 32 > model->intrinsics.width_px) {
    config.Map("stereo").Fault(
        "disparities_px",
        {FaultKind::kOutOfRange,
         fmt::format("{} leaves nothing of a picture {} px wide to be matched; need at most {}",
                     model->stereo->disparities_px, model->intrinsics.width_px,
                     std::max(16, (model->intrinsics.width_px - 32) / 16 * 16))});
  }
}

ObjectLabels ReadObjectLabels(const ConfigMap& config, const CameraModel& model) {
  ObjectLabels labels;
  if (!config.Has("object_labels")) return labels;
  const std::vector<std::string> known = {"exposure", "load"};
  for (const std::string& name : config.Texts("object_labels")) {
    if (name == known[0]) {
      labels.exposure = true;
    } else if (name == known[1]) {
      labels.load = true;
    } else {
      config.Fault("object_labels",
                   {FaultKind::kNoSuchName,
                    fmt::format("'{}' is no label of objects{}; need some of {}", name,
                                DidYouMean(name, known), fmt::join(known, ", "))});
    }
  }
  if (!model.labels[kInstanceChannel]) {
    config.Fault("object_labels",
                 "are of what the instance picture shows, which is off; need labels: true, or "
                 "instance among them");
  }
  if (labels.exposure && !model.image_sensor) {
    config.Fault("object_labels",
                 "'exposure' is that of an image sensor, which this camera has not; need "
                 "image_sensor, or to leave it out");
  }
  return labels;
}

std::string ObjectLabelsYaml(const ObjectLabels& labels) {
  std::vector<std::string> names;
  if (labels.exposure) names.emplace_back("exposure");
  if (labels.load) names.emplace_back("load");
  return names.empty() ? "" : fmt::format("  object_labels: [{}]\n", fmt::join(names, ", "));
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
  ReadDepthSensor(config, &m);
  m.baseline_m = config.Number("baseline_m", Positive("m"), m.baseline_m);
  // An image sensor replaces the noise of a preset.
  if (!LiesBelow(config, "rgb_noise", "image_sensor")) {
    m.rgb_noise = config.Number("rgb_noise", Between(0, kMaxValue, "of 255"), 0);
  }
  if (const auto sensor = config.OptionalMap("image_sensor")) {
    m.image_sensor = ReadModel<ImageSensorModel>(*sensor);
    if (m.rgb_noise > 0) {
      config.Fault("rgb_noise", "given beside image_sensor, which has noise of its own; keep one");
    }
    if (!m.rgb) config.Fault("image_sensor", "makes colour, which is off; need rgb: true");
    CheckLabelsUnderShutter(config, m);
  }
  if (const auto optics = config.OptionalMap("optics")) {
    m.optics = ReadModel<OpticsModel>(*optics);
    if (!m.image_sensor) {
      config.Fault("optics",
                   "changes the luminance before an image sensor, which this camera has not; need "
                   "image_sensor, whose f_number and pixel_um it has");
    }
  }
  m.object_labels = ReadObjectLabels(config, m);
  return m;
}

std::string CameraModelYaml(const CameraModel& m) {
  std::string text =
      LensYaml(m.intrinsics) +
      fmt::format(
          "  rgb: {}\n  depth: {}\n  labels: {}\n  depth_min_m: {}\n  depth_max_m: {}\n"
          "  disparity_noise_px: {}\n  baseline_m: {}\n  rgb_noise: {}\n",
          m.rgb, m.depth, LabelsYaml(m.labels), m.depth_min_m, m.depth_max_m, m.disparity_noise_px,
          m.baseline_m, m.rgb_noise);
  text += ObjectLabelsYaml(m.object_labels);
  if (m.stereo) text += "  stereo:\n" + ModelYaml(*m.stereo, 4);
  if (m.time_of_flight) text += "  time_of_flight:\n" + ModelYaml(*m.time_of_flight, 4);
  if (m.image_sensor) text += "  image_sensor:\n" + ModelYaml(*m.image_sensor, 4);
  if (m.optics) text += "  optics:\n" + ModelYaml(*m.optics, 4);
  return text;
}

}  // namespace tera
