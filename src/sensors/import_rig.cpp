#include "sensors/import_rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/config/config.h"
#include "core/config/spelling.h"
#include "core/units.h"
#include "sensors/sensor_kinds.h"

namespace tera {
namespace {

/// A type of the form; rates are for what the form leaves open: those of the paper's set-up where
/// it names one.
struct ForeignType {
  std::string name;
  std::string head;    ///< of the sensor's item: its preset or type
  double rate_hz = 0;  ///< 0: as the preset has it
  bool has_mean = false;
  std::string (*noise)(double mean, double std) = nullptr;  ///< null: as the preset has it
};

std::string Thrice(double value) { return fmt::format("[{0}, {0}, {0}]", value); }

std::string ImuNoise(double mean, double std) {
  return fmt::format(
      "    gyro_bias_degps: [{0:.12g}, {0:.12g}, {0:.12g}]\n    gyro_sample_noise_degps: "
      "{1:.12g}\n    accel_bias_mps2: {2}\n    accel_sample_noise_mps2: {3}\n",
      mean / kDeg, std / kDeg, Thrice(mean), std);
}

std::string GpsNoise(double mean, double std) {
  return fmt::format(
      "    bias_enu_m: {0}\n    white_horizontal_m: {1}\n    white_vertical_m: {1}\n"
      "    fix: single\n",
      Thrice(mean), std);
}

std::string RangeNoise(double, double std) { return fmt::format("    range_noise_m: {}\n", std); }

std::string ColourNoise(double, double std) { return fmt::format("    rgb_noise: {}\n", std); }

std::string Capitals(std::string_view name) {
  std::string capitals(name);
  for (char& c : capitals) {
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return capitals;
}

/// The types of the paper, and every other kind of sensor on a link whose samples are rows, by its
/// own name, as its preset of that name has it.
std::vector<ForeignType> ForeignTypes() {
  const std::string presets = "preset: tera:config/sensors/";
  std::vector<ForeignType> types = {
      {"IMU", "type: imu", 100, true, ImuNoise},
      {"GPS", "type: gnss", 10, true, GpsNoise},
      {"LIDAR", presets + "vlp16.yaml", 10, false, RangeNoise},
      {"RGB_CAMERA", presets + "rgb_640.yaml", 10, false, ColourNoise},
      {"RGBD_CAMERA", presets + "realsense_d435i.yaml", 10, false, ColourNoise}};
  for (const SensorKind* kind : kSensorKinds) {
    const bool is_of_the_paper = kind == &kImuKind || kind == &kGnssKind;
    if (!kind->on_link || kind->form != ChannelForm::kRows || is_of_the_paper) continue;
    types.push_back(
        {.name = Capitals(kind->name), .head = fmt::format("{}{}.yaml", presets, kind->name)});
  }
  return types;
}

const std::vector<ForeignType>& Types() {
  static const std::vector<ForeignType> types = ForeignTypes();
  return types;
}

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

/// The IMU where the type is not known, which is a fault.
const ForeignType* ReadType(const ConfigMap& config) {
  std::vector<std::string> names;
  const std::string type = config.Text("type");
  for (const ForeignType& known : Types()) {
    if (known.name == type) return &known;
    names.push_back(known.name);
  }
  if (!type.empty()) {
    config.Fault("type", fmt::format("'{}' is not known, need one of {}{}", type,
                                     fmt::join(names, ", "), DidYouMean(type, names)));
  }
  return &Types().front();
}

ForeignSensor ReadForeignSensor(const ConfigMap& config) {
  ForeignSensor s;
  const std::string id = config.Text("id");
  s.name = NameFrom(config.Text("topic", id));
  s.type = ReadType(config);
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
    if (s.mean != 0 && !s.type->has_mean) {
      config.Fault("noise", fmt::format("mean {} on a {}; need 0, only IMU and GPS have a bias",
                                        s.mean, s.type->name));
    }
    if (s.std > 0 && !s.type->noise) {
      config.Fault("noise", fmt::format("std {} on a {}; need none, its preset has its noise",
                                        s.std, s.type->name));
    }
  }
  s.X_BS = MakePose(FromUnity(config.Vector3("offset", Any("m"), Vec3::Zero())),
                    RotationFromUnityEuler(config.Vector3("rotation", Any("deg"), Vec3::Zero())));
  return s;
}

std::string SensorItem(const ForeignSensor& s) {
  const Vec3 p = s.X_BS.translation();
  const Vec3 rpy_deg = RpyFromRotation(s.X_BS.linear()) / kDeg;
  std::string text = fmt::format(
      "  - name: {}\n    {}\n    link: {}\n    xyz_m: [{:.12g}, {:.12g}, {:.12g}]\n    rpy_deg: "
      "[{:.12g}, {:.12g}, {:.12g}]\n",
      s.name, s.type->head, s.link, p.x(), p.y(), p.z(), rpy_deg.x(), rpy_deg.y(), rpy_deg.z());
  if (s.type->rate_hz > 0) text += fmt::format("    rate_hz: {}\n", s.type->rate_hz);
  if (s.type->noise) text += s.type->noise(s.mean, s.std);
  return text;
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
