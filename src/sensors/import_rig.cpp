#include "sensors/import_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/config/config.h"
#include "core/units.h"

namespace tera {
namespace {

/// Rates for what the form leaves open: those of the paper's set-up where it names one.
struct ForeignType {
  std::string_view name;
  std::string_view preset;
  double rate_hz;
};
constexpr std::array<ForeignType, 5> kTypes = {{
    {"IMU", "", 100},
    {"GPS", "", 10},
    {"LIDAR", "tera:config/sensors/vlp16.yaml", 10},
    {"RGB_CAMERA", "tera:config/sensors/rgb_640.yaml", 10},
    {"RGBD_CAMERA", "tera:config/sensors/realsense_d435i.yaml", 10},
}};

struct Location {
  std::string_view name, link;
};
constexpr std::array<Location, 5> kLocations = {{
    {"CHASSIS", "upper"},
    {"CHASIS", "upper"},
    {"BOOM", "boom"},
    {"ARM", "arm"},
    {"BUCKET", "bucket"},
}};

Vec3 FromUnity(const Vec3& v) { return {v.z(), -v.x(), v.y()}; }

Mat3 RotationFromUnityEuler(const Vec3& deg) {
  const Vec3 rad = deg * kDeg;
  // A left-handed turn by an angle has the same matrix in left-handed axes as a right-handed one
  // in right-handed axes.
  const Mat3 R =
      (Eigen::AngleAxisd(rad.y(), Vec3::UnitY()) * Eigen::AngleAxisd(rad.x(), Vec3::UnitX()) *
       Eigen::AngleAxisd(rad.z(), Vec3::UnitZ()))
          .toRotationMatrix();
  Mat3 to_ours;
  for (int axis = 0; axis < 3; ++axis) to_ours.col(axis) = FromUnity(Vec3::Unit(axis));
  return to_ours * R * to_ours.transpose();
}

struct ForeignSensor {
  std::string name;
  const ForeignType* type = nullptr;
  std::string link;
  double mean = 0, std = 0;
  Pose X_BS = Pose::Identity();
};

/// Letters, digits, '_' and '-' of the last part of `topic`.
std::string NameFrom(const std::string& topic) {
  std::string name = topic.substr(topic.find_last_of('/') + 1);
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  }
  return name;
}

ForeignSensor ReadForeignSensor(const ConfigMap& config) {
  ForeignSensor s;
  const std::string id = config.Text("id");
  s.name = NameFrom(config.Text("topic", id));
  const std::string type =
      config.Choice("type", {"IMU", "GPS", "LIDAR", "RGB_CAMERA", "RGBD_CAMERA"});
  s.type = std::find_if(kTypes.begin(), kTypes.end(),
                        [&](const ForeignType& t) { return t.name == type; });
  const std::string place =
      config.Choice("location", {"CHASSIS", "CHASIS", "BOOM", "ARM", "BUCKET"});
  for (const Location& l : kLocations) {
    if (l.name == place) s.link = l.link;
  }
  if (config.Has("noise")) {
    const std::vector<double> noise = config.Numbers("noise", Any(""), 2, 2);
    s.mean = noise[0];
    s.std = noise[1];
    if (s.std < 0) config.Fault("noise", "negative std; need [mean, std] with std at least 0");
    if (s.mean != 0 && type != "IMU" && type != "GPS") {
      config.Fault("noise", fmt::format("mean {} on a {}; need 0, only IMU and GPS have a bias",
                                        s.mean, type));
    }
  }
  s.X_BS = MakePose(FromUnity(config.Vector3("offset", Any("m"), Vec3::Zero())),
                    RotationFromUnityEuler(config.Vector3("rotation", Any("deg"), Vec3::Zero())));
  return s;
}

std::string NoiseYaml(const ForeignSensor& s) {
  const std::string same = fmt::format("[{0}, {0}, {0}]", s.mean);
  if (s.type->name == "IMU") {
    const double mean_degps = s.mean / kDeg;
    return fmt::format(
        "    gyro_bias_degps: [{0:.12g}, {0:.12g}, {0:.12g}]\n    gyro_sample_noise_degps: "
        "{1:.12g}\n    accel_bias_mps2: {2}\n    accel_sample_noise_mps2: {3}\n",
        mean_degps, s.std / kDeg, same, s.std);
  }
  if (s.type->name == "GPS") {
    return fmt::format(
        "    bias_enu_m: {0}\n    white_horizontal_m: {1}\n    white_vertical_m: {1}\n"
        "    fix: single\n",
        same, s.std);
  }
  if (s.type->name == "LIDAR") return fmt::format("    range_noise_m: {}\n", s.std);
  return fmt::format("    rgb_noise: {}\n", s.std);
}

std::string SensorItem(const ForeignSensor& s) {
  const Vec3 p = s.X_BS.translation();
  const Vec3 rpy_deg = RpyFromRotation(s.X_BS.linear()) / kDeg;
  std::string text = fmt::format("  - name: {}\n", s.name);
  if (s.type->preset.empty()) {
    text += fmt::format("    type: {}\n", s.type->name == "IMU" ? "imu" : "gnss");
  } else {
    text += fmt::format("    preset: {}\n", s.type->preset);
  }
  text += fmt::format(
      "    link: {}\n    xyz_m: [{:.12g}, {:.12g}, {:.12g}]\n    rpy_deg: [{:.12g}, {:.12g}, "
      "{:.12g}]\n    rate_hz: {}\n",
      s.link, p.x(), p.y(), p.z(), rpy_deg.x(), rpy_deg.y(), rpy_deg.z(), s.type->rate_hz);
  return text + NoiseYaml(s);
}

struct ForeignMachine {
  std::string id;
  std::vector<ForeignSensor> sensors;
};

ForeignMachine ReadForeignMachine(const ConfigMap& config) {
  ForeignMachine machine;
  machine.id = config.Text("id");
  config.Text("type", "");
  config.Vector3("offset", Any("m"), Vec3::Zero());
  config.Vector3("rotation", Any("deg"), Vec3::Zero());
  std::vector<std::string> names;
  for (const ConfigMap& item : config.List("sensors")) {
    const ForeignSensor sensor = ReadForeignSensor(item);
    if (std::find(names.begin(), names.end(), sensor.name) != names.end()) {
      item.Fault("topic", fmt::format("a second sensor named '{}' on this machine; need another "
                                      "last part of the topic",
                                      sensor.name));
    }
    names.push_back(sensor.name);
    machine.sensors.push_back(sensor);
  }
  return machine;
}

}  // namespace

std::string ImportRig(const std::filesystem::path& file, const std::string& machine) {
  const Config config = Config::FromFile(file);
  std::vector<ForeignMachine> machines;
  for (const ConfigMap& item : config.root().List("Excavator")) {
    machines.push_back(ReadForeignMachine(item));
  }
  std::string ids;
  for (const ForeignMachine& m : machines) ids += (ids.empty() ? "" : ", ") + m.id;
  const auto chosen = std::find_if(machines.begin(), machines.end(), [&](const ForeignMachine& m) {
    return machine.empty() || m.id == machine;
  });
  if (machines.empty()) {
    config.root().Fault("", "no machine under 'Excavator'; need a list of {id, type, sensors}");
  } else if (machine.empty() && machines.size() > 1) {
    config.root().Fault("Excavator", fmt::format("several machines; choose one of {}", ids));
  } else if (chosen == machines.end()) {
    config.root().Fault("Excavator", fmt::format("no machine '{}'; need one of {}", machine, ids));
  }
  config.Finish();
  std::string text = fmt::format("# Sensors of '{}', imported from {}.\nsensors:\n", chosen->id,
                                 file.filename().string());
  for (const ForeignSensor& sensor : chosen->sensors) text += SensorItem(sensor);
  return text;
}

}  // namespace tera
