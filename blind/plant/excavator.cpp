#include "blind/plant/excavator.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"

namespace tera::blind {
namespace {

constexpr double kGravity_mps2 = 9.80665;
constexpr double kArm_m = 0.25;  ///< of a cylinder about its joint, where effort is not given
constexpr double kDeg = std::numbers::pi / 180;

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d Triple(const YAML::Node& node) {
  return {node[0].as<double>(), node[1].as<double>(), node[2].as<double>()};
}

Matrix3d Turned(const YAML::Node& joint) {
  if (!joint["rpy_deg"]) return Matrix3d::Identity();
  const Vector3d rpy = Triple(joint["rpy_deg"]) * kDeg;
  using Eigen::AngleAxisd;
  return (AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
          AngleAxisd(rpy.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

void ReadLimits(const YAML::Node& joint, PlainAxis* axis) {
  if (joint["initial_deg"]) axis->initial_rad = joint["initial_deg"].as<double>() * kDeg;
  if (joint["limits_deg"]) {
    axis->lower_rad = joint["limits_deg"][0].as<double>() * kDeg;
    axis->upper_rad = joint["limits_deg"][1].as<double>() * kDeg;
  } else if (joint["limits_rad"]) {
    axis->lower_rad = joint["limits_rad"][0].as<double>();
    axis->upper_rad = joint["limits_rad"][1].as<double>();
  } else {
    axis->lower_rad = -1e9;
    axis->upper_rad = 1e9;
  }
  const YAML::Node rate = joint["max_rate_degps"];
  axis->rate_positive_radps = (rate.IsSequence() ? rate[0] : rate).as<double>() * kDeg;
  axis->rate_negative_radps = (rate.IsSequence() ? rate[1] : rate).as<double>() * kDeg;
}

/// Reads the joint's drive: its own effort, or else that of its cylinder.
void ReadDrive(const YAML::Node& file, const std::string& name, PlainAxis* axis) {
  const YAML::Node joint = file["joints"][name];
  if (joint["max_effort_nm"]) {
    axis->effort_nm = joint["max_effort_nm"].as<double>();
    return;
  }
  const YAML::Node cylinder = file["cylinders"][name + "_cylinder"];
  const double bore_m = cylinder["bore_m"].as<double>();
  axis->effort_nm = file["hydraulics"]["relief_pa"].as<double>() * std::numbers::pi / 4 * bore_m *
                    bore_m * kArm_m;
  axis->has_pins = static_cast<bool>(cylinder["rod"]["pin_m"]);
  if (!axis->has_pins) return;
  axis->barrel_m = Triple(cylinder["barrel"]["pin_m"]);
  axis->rod_m = Triple(cylinder["rod"]["pin_m"]);
}

PlainAxis ReadAxis(const YAML::Node& file, const std::string& name) {
  PlainAxis axis;
  const YAML::Node joint = file["joints"][name];
  axis.place_m = Triple(joint["xyz_m"]);
  axis.turned = Turned(joint);
  axis.axis = Triple(joint["axis"]);
  ReadLimits(joint, &axis);
  ReadDrive(file, name, &axis);
  const YAML::Node link = file["links"][joint["child"].as<std::string>()];
  axis.mass_kg = link["mass_kg"].as<double>();
  axis.com_m = Triple(link["com_m"]);
  axis.inertia_kgm2 = Triple(link["inertia_kgm2"]);
  return axis;
}

}  // namespace

/// Where a link is in the undercarriage's frame.
struct Excavator::Placed {
  Matrix3d R;
  Vector3d origin_m, com_m, axis;
};

Excavator Excavator::Read(const std::filesystem::path& machine_yaml) {
  try {
    const YAML::Node file = YAML::LoadFile(machine_yaml.string());
    Excavator excavator;
    for (std::size_t i = 0; i < kAxes; ++i) excavator.axes_[i] = ReadAxis(file, kJoints[i]);
    // The post of the boom's swing is welded to the upper structure.
    const YAML::Node swing = file["joints"]["swing"];
    const Vector3d post_m = Triple(swing["xyz_m"]);
    excavator.axes_[1].place_m += post_m;
    PlainAxis& upper = excavator.axes_[0];
    const YAML::Node post = file["links"]["swing_post"];
    const double mass_kg = post["mass_kg"].as<double>();
    const Vector3d com_m = post_m + Triple(post["com_m"]);
    upper.com_m = (upper.mass_kg * upper.com_m + mass_kg * com_m) / (upper.mass_kg + mass_kg);
    upper.mass_kg += mass_kg;
    // Its cylinder's pin is in the post's frame, and so in the upper structure's.
    excavator.axes_[1].barrel_m += post_m;
    return excavator;
  } catch (const YAML::Exception& e) {
    throw InputError(fmt::format("{}: {}; need an excavator with slew, boom, arm and bucket",
                                 machine_yaml.string(), e.what()));
  }
}

Excavator Excavator::Off(double share, const Stream& stream) const {
  Excavator off = *this;
  std::uint64_t draw = 0;
  const auto factor = [&] { return 1 + share * (2 * stream.Uniform(draw++) - 1); };
  for (PlainAxis& axis : off.axes_) {
    const double rate = factor();
    axis.rate_positive_radps *= rate;
    axis.rate_negative_radps *= rate;
    axis.effort_nm *= factor();
    const double mass = factor();
    axis.mass_kg *= mass;
    axis.inertia_kgm2 *= mass;
    axis.com_m *= factor();
  }
  return off;
}

std::array<Excavator::Placed, kAxes> Excavator::Place(const AxisValues& q_rad) const {
  std::array<Placed, kAxes> placed;
  Matrix3d R = Matrix3d::Identity();
  Vector3d origin_m = Vector3d::Zero();
  for (std::size_t i = 0; i < kAxes; ++i) {
    const PlainAxis& axis = axes_[i];
    origin_m += R * axis.place_m;
    R = R * axis.turned * Eigen::AngleAxisd(q_rad[i], axis.axis).toRotationMatrix();
    placed[i] = {R, origin_m, origin_m + R * axis.com_m, R * axis.axis};
  }
  return placed;
}

AxisValues Excavator::Loads_nm(const AxisValues& q_rad) const {
  const auto placed = Place(q_rad);
  AxisValues loads{};
  for (std::size_t i = 0; i < kAxes; ++i) {
    for (std::size_t k = i; k < kAxes; ++k) {
      const Vector3d lift = placed[i].axis.cross(placed[k].com_m - placed[i].origin_m);
      loads[i] += axes_[k].mass_kg * kGravity_mps2 * lift.z();
    }
  }
  return loads;
}

AxisValues Excavator::Inertias_kgm2(const AxisValues& q_rad) const {
  const auto placed = Place(q_rad);
  AxisValues inertias{};
  for (std::size_t i = 0; i < kAxes; ++i) {
    for (std::size_t k = i; k < kAxes; ++k) {
      const Vector3d about = placed[k].R.transpose() * placed[i].axis;
      inertias[i] += about.cwiseProduct(axes_[k].inertia_kgm2).dot(about);
      inertias[i] += axes_[k].mass_kg *
                     placed[i].axis.cross(placed[k].com_m - placed[i].origin_m).squaredNorm();
    }
  }
  return inertias;
}

double Excavator::PinSlope_mprad(std::size_t i, double q_rad) const {
  const PlainAxis& axis = axes_[i];
  const auto length_m = [&](double q) {
    const Vector3d rod_m =
        axis.place_m + axis.turned * (Eigen::AngleAxisd(q, axis.axis) * axis.rod_m);
    return (rod_m - axis.barrel_m).norm();
  };
  constexpr double kStep_rad = 1e-4;
  return (length_m(q_rad + kStep_rad) - length_m(q_rad - kStep_rad)) / (2 * kStep_rad);
}

}  // namespace tera::blind
