#include "sensors/import_rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/config/config.h"
#include "core/config/fault_text.h"
#include "core/config/plain_name.h"
#include "core/units.h"
#include "sensors/sensor_kinds.h"

namespace tera {
namespace {

/// A sensor type of the input. Rates come from the set-up in the paper where it states them.
struct ForeignType {
  std::string name;
  std::string head;    ///< preset or type line of the output
  double rate_hz = 0;  ///< 0: rate of the preset
  /// meaning of a mean in the output
  enum class Mean { kNone, kConstant, kRangeBias } mean = Mean::kNone;
  std::string (*noise)(double mean, double std) = nullptr;  ///< null: noise of the preset
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

/// The types of the paper, and every other link-mounted sensor kind with row samples. The latter
/// use the preset of their own name.
std::vector<ForeignType> ForeignTypes() {
  using Mean = ForeignType::Mean;
  const std::string presets = "preset: tera:config/sensors/";
  std::vector<ForeignType> types = {
      {"IMU", "type: imu", 100, Mean::kConstant, ImuNoise},
      {"GPS", "type: gnss", 10, Mean::kConstant, GpsNoise},
      {"LIDAR", presets + "vlp16.yaml", 10, Mean::kRangeBias, RangeNoise},
      {"RGB_CAMERA", presets + "rgb_640.yaml", 10, Mean::kNone, ColourNoise},
      {"RGBD_CAMERA", presets + "realsense_d435i.yaml", 10, Mean::kNone, ColourNoise}};
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
  // A left-handed rotation in left-handed axes has the same matrix as a right-handed rotation in
  // right-handed axes.
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

/// Last part of `topic`, with other characters than letters, digits, '_' and '-' replaced by '_'.
std::string NameFrom(const std::string& topic) {
  std::string name = topic.substr(topic.find_last_of('/') + 1);
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  }
  return name;
}

/// Type of the sensor. An unknown type is a fault and returns the IMU.
const ForeignType* ReadType(const ConfigMap& config) {
  std::vector<std::string> names;
  const std::string type = config.Text("type");
  for (const ForeignType& known : Types()) {
    if (known.name == type) return &known;
    names.push_back(known.name);
  }
  if (!type.empty()) {
    config.Fault("type", fault::NotKnown(type, names));
  }
  return &Types().front();
}

/// Three numbers, as [x, y, z] or {x, y, z}; zero if the key is absent.
Vec3 ReadUnityVector(const ConfigMap& config, std::string_view key, const std::string& unit) {
  if (!config.Has(key) || config.IsList(key)) return config.Vector3(key, Any(unit), Vec3::Zero());
  const ConfigMap map = config.Map(key);
  return {map.Number("x", Any(unit), 0), map.Number("y", Any(unit), 0),
          map.Number("z", Any(unit), 0)};
}

Pose ReadUnityPose(const ConfigMap& config) {
  const Vec3 offset_m = ReadUnityVector(config, "offset", "m");
  return MakePose(FromUnity(offset_m),
                  RotationFromUnityEuler(ReadUnityVector(config, "rotation", "deg")));
}

/// Reads `noise`, as [mean, std] or {mean, std_dev}.
void ReadNoise(const ConfigMap& config, ForeignSensor* s) {
  if (config.IsList("noise")) {
    const std::vector<double> noise = config.Numbers("noise", Any(""), 2, 2);
    s->mean = noise[0];
    s->std = noise[1];
  } else {
    const ConfigMap noise = config.Map("noise");
    s->mean = noise.Number("mean", Any(""), 0);
    s->std = noise.Number("std_dev", Any(""), 0);
  }
  if (s->std < 0) config.Fault("noise", "negative std; need one of at least 0");
  if (s->mean != 0 && s->type->mean == ForeignType::Mean::kNone) {
    config.Fault("noise",
                 fmt::format("mean {} on a {}; need 0, only IMU, GPS and LIDAR have a bias",
                             s->mean, s->type->name));
  }
  if (s->std > 0 && !s->type->noise) {
    config.Fault("noise", fmt::format("std {} on a {}; need none, its preset has its noise", s->std,
                                      s->type->name));
  }
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
  if (config.Has("noise")) ReadNoise(config, &s);
  s.X_BS = ReadUnityPose(config);
  return s;
}

/// YAML item of a sensor list; each line starts with `indent`.
std::string SensorItem(const ForeignSensor& s, const std::string& indent) {
  const Vec3 p = s.X_BS.translation();
  const Vec3 rpy_deg = RpyFromRotation(s.X_BS.linear()) / kDeg;
  std::string text = fmt::format(
      "  - name: {}\n    {}\n    link: {}\n    xyz_m: [{:.12g}, {:.12g}, {:.12g}]\n    rpy_deg: "
      "[{:.12g}, {:.12g}, {:.12g}]\n",
      s.name, s.type->head, s.link, p.x(), p.y(), p.z(), rpy_deg.x(), rpy_deg.y(), rpy_deg.z());
  if (s.type->rate_hz > 0) text += fmt::format("    rate_hz: {}\n", s.type->rate_hz);
  if (s.type->noise) text += s.type->noise(s.mean, s.std);
  std::string indented;
  for (const char c : text) {
    if (indented.empty() || indented.back() == '\n') indented += indent;
    indented += c;
  }
  return indented;
}

struct ForeignMachine {
  std::string id;
  Pose X_WB = Pose::Identity();
  std::vector<ForeignSensor> sensors;
};

/// `name` is the key of the machine in a mapping, else empty.
ForeignMachine ReadForeignMachine(const std::string& name, const ConfigMap& config) {
  ForeignMachine machine;
  machine.id = name.empty() ? config.Text("id") : config.Text("id", name);
  config.Text("type", "");
  config.Text("name", "");
  machine.X_WB = ReadUnityPose(config);
  std::vector<std::string> names;
  for (const ConfigMap& item : config.List("sensors")) {
    const ForeignSensor sensor = ReadForeignSensor(item);
    if (std::find(names.begin(), names.end(), sensor.name) != names.end()) {
      item.Fault("topic", {FaultKind::kRepeated,
                           fmt::format("a second sensor named '{}' on this machine; need another "
                                       "last part of the topic",
                                       sensor.name)});
    }
    names.push_back(sensor.name);
    machine.sensors.push_back(sensor);
  }
  return machine;
}

constexpr std::string_view kMachineKeys[] = {"Excavator", "machines"};

/// Machines of the first present key, as a list or as a mapping by id.
std::vector<ForeignMachine> ReadForeignMachines(const ConfigMap& root) {
  std::vector<ForeignMachine> machines;
  const auto take = [&](const std::string& name, const ConfigMap& map) {
    machines.push_back(ReadForeignMachine(name, map));
    const std::string& id = machines.back().id;
    const auto same = [&](const ForeignMachine& machine) { return machine.id == id; };
    if (std::count_if(machines.begin(), machines.end(), same) > 1) {
      map.Fault("id",
                {FaultKind::kRepeated, fmt::format("a second machine '{}'; need another id", id)});
    }
  };
  for (const std::string_view key : kMachineKeys) {
    if (!root.Has(key)) continue;
    if (root.IsList(key)) {
      for (const ConfigMap& item : root.List(key)) take("", item);
    } else {
      for (const auto& [name, map] : root.NamedMaps(key)) take(name, map);
    }
    if (machines.empty()) break;
    return machines;
  }
  root.Fault("",
             {FaultKind::kMissing,
              "no machine under 'Excavator'; need a list of {id, type, sensors}, or a mapping of "
              "these by id"});
  return machines;
}

/// Sensor effects of a machine, which belong to a scenario and not to a rig; empty without effects.
std::string EffectsOf(const ForeignMachine& machine) {
  std::string text;
  for (const ForeignSensor& s : machine.sensors) {
    if (s.mean == 0 || s.type->mean != ForeignType::Mean::kRangeBias) continue;
    text += fmt::format("{}{}: {{range_bias: {{range_m: {}}}}}", text.empty() ? "" : ", ", s.name,
                        s.mean);
  }
  return text.empty() ? text : fmt::format("{}: {{{}}}", machine.id, text);
}

/// Removes rounding noise of rotations, and the sign of zero.
double Tidy(double value) { return std::round(1e9 * value) / 1e9 + 0.0; }

/// Start of a machine in a scenario, with a note on pose components that the ground determines.
std::string StartOf(const ForeignMachine& machine) {
  const Vec3 p_m = machine.X_WB.translation().unaryExpr(&Tidy);
  const Vec3 rpy_deg = (RpyFromRotation(machine.X_WB.linear()) / kDeg).unaryExpr(&Tidy);
  std::string text = fmt::format("start: {{xy_m: [{:.12g}, {:.12g}], yaw_deg: {:.12g}}}", p_m.x(),
                                 p_m.y(), rpy_deg.z());
  if (p_m.z() != 0 || !rpy_deg.head<2>().isZero(0)) {
    text +=
        fmt::format("  # height {:.4g} m, roll {:.4g} and pitch {:.4g} deg are left to the ground",
                    p_m.z(), rpy_deg.x(), rpy_deg.y());
  }
  return text + "\n";
}

std::string RigOf(const ForeignMachine& machine, const std::string& file) {
  std::string text = fmt::format("# Sensors of '{}', imported from {}.\n", machine.id, file);
  if (!machine.X_WB.isApprox(Pose::Identity())) {
    text += "# In a scenario the machine has " + StartOf(machine);
  }
  if (const std::string effects = EffectsOf(machine); !effects.empty()) {
    text += fmt::format("# In a scenario it has effects: {{{}}}\n", effects);
  }
  text += "sensors:\n";
  for (const ForeignSensor& sensor : machine.sensors) text += SensorItem(sensor, "");
  return text;
}

/// The keys `machines` and `effects` of a scenario.
std::string MachinesOf(const std::vector<ForeignMachine>& machines, const std::string& file) {
  std::string text = fmt::format("# Machines of a scenario, imported from {}.\nmachines:\n", file);
  std::string effects;
  for (const ForeignMachine& machine : machines) {
    text += fmt::format(
        "  - name: {}\n    machine: tera:config/machines/tb235.yaml\n    operator: {{type: idle}}\n"
        "    {}    rig:\n      sensors:{}\n",
        machine.id, StartOf(machine), machine.sensors.empty() ? " []" : "");
    for (const ForeignSensor& sensor : machine.sensors) text += SensorItem(sensor, "      ");
    const std::string own = EffectsOf(machine);
    if (!own.empty()) effects += "  " + own + "\n";
  }
  return effects.empty() ? text : text + "effects:\n" + effects;
}

}  // namespace

std::string ImportRig(const std::filesystem::path& file, const std::string& machine) {
  const Config config = Config::FromFile(file);
  const ConfigMap root = config.root();
  const std::vector<ForeignMachine> machines = ReadForeignMachines(root);
  std::vector<std::string> ids;
  for (const ForeignMachine& m : machines) ids.push_back(m.id);
  const auto chosen = std::find_if(machines.begin(), machines.end(), [&](const ForeignMachine& m) {
    return machine.empty() || m.id == machine;
  });
  if (chosen == machines.end() && !machines.empty()) {
    root.Fault("", {FaultKind::kNoSuchName,
                    fmt::format("no machine '{}'; need one of {}", machine, fmt::join(ids, ", "))});
  }
  const bool is_several = machine.empty() && machines.size() > 1;
  for (const std::string& id : ids) {
    if (is_several) RequirePlainName(root, "", id);
  }
  config.Finish();
  const std::string name = file.filename().string();
  return is_several ? MachinesOf(machines, name) : RigOf(*chosen, name);
}

}  // namespace tera
