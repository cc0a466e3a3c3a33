#include "blind/mujoco/machine/machine_numbers.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <numbers>

#include "core/error.h"

namespace tera::blind::mujoco {
namespace {

Vec3 VectorOf(const YAML::Node& node) {
  return {node[0].as<double>(), node[1].as<double>(), node[2].as<double>()};
}

std::size_t LinkCalled(const std::string& name) {
  const auto* found = std::find(kLinkNames.begin(), kLinkNames.end(), name);
  if (found == kLinkNames.end()) throw InputError(fmt::format("no link is called {}", name));
  return static_cast<std::size_t>(found - kLinkNames.begin());
}

JointNumbers JointOf(const YAML::Node& node) {
  JointNumbers joint;
  joint.pin_m = VectorOf(node["xyz_m"]);
  joint.axis = VectorOf(node["axis"]);
  if (const YAML::Node limits = node["limits_rad"]) {
    joint.has_stops = true;
    joint.lower_rad = limits[0].as<double>();
    joint.upper_rad = limits[1].as<double>();
  }
  return joint;
}

void ReadMachine(const YAML::Node& machine, MachineNumbers* out) {
  for (std::size_t i = 0; i < kLinkCount; ++i) {
    const YAML::Node link = machine["links"][kLinkNames[i]];
    out->links[i] = {link["mass_kg"].as<double>(), VectorOf(link["com_m"]),
                     VectorOf(link["inertia_kgm2"])};
  }
  for (std::size_t i = kSlew; i < kAxisCount; ++i) {
    const YAML::Node joint = machine["joints"][kAxisNames[i]];
    out->joints[i] = JointOf(joint);
    out->full_rate_radps[i] = joint["max_rate_degps"].as<double>() * std::numbers::pi / 180;
  }
  for (const std::size_t i : {kLeftTrack, kRightTrack}) {
    const YAML::Node track = machine["tracks"][kAxisNames[i]];
    out->radius_m = track["radius_m"].as<double>();
    out->contact_m = track["wheelbase_m"].as<double>();
    out->full_rate_radps[i] = track["max_speed_mps"].as<double>() / out->radius_m;
  }
  out->gauge_m = machine["gauge_m"].as<double>();
  out->oil = OilOf(machine["kind"].as<std::string>());
}

void ReadRig(const YAML::Node& rig, MachineNumbers* out) {
  std::size_t units = 0, antennas = 0;
  for (const YAML::Node& sensor : rig["sensors"]) {
    const std::string name = sensor["name"].as<std::string>();
    if (!sensor["link"]) continue;
    const Mount mount{name, LinkCalled(sensor["link"].as<std::string>()),
                      VectorOf(sensor["xyz_m"])};
    if (name.starts_with("imu")) out->units.at(units++) = mount;
    if (name.starts_with("gnss")) out->antennas.at(antennas++) = mount;
  }
}

}  // namespace

MachineNumbers MachineNumbers::Read(const std::filesystem::path& machine_yaml,
                                    const std::filesystem::path& rig_yaml) {
  try {
    MachineNumbers numbers;
    ReadMachine(YAML::LoadFile(machine_yaml.string()), &numbers);
    ReadRig(YAML::LoadFile(rig_yaml.string()), &numbers);
    return numbers;
  } catch (const YAML::Exception& e) {
    throw InputError(fmt::format("{} and {}: {}; need a machine and a rig as examples/prove has",
                                 machine_yaml.string(), rig_yaml.string(), e.what()));
  }
}

}  // namespace tera::blind::mujoco
