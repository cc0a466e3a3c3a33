#include "physics/description/urdf_transmissions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/config/plain_name.h"
#include "core/config/spelling.h"
#include "core/units.h"

namespace tera {
namespace {

using Element = tinyxml2::XMLElement;

constexpr std::array<std::string_view, 3> kInterfaces = {
    "PositionJointInterface", "VelocityJointInterface", "EffortJointInterface"};

/// Limits of a rotating actuator, at the motor before its reduction.
struct ActuatorLimits {
  std::optional<double> max_rate_radps, max_effort_nm;
  bool used = false;
};

std::string Attribute(const Element& element, const char* name) {
  const char* text = element.Attribute(name);
  return text ? text : "";
}

std::vector<const Element*> Children(const Element& parent, const char* name) {
  std::vector<const Element*> children;
  for (const Element* e = parent.FirstChildElement(name); e; e = e->NextSiblingElement(name)) {
    children.push_back(e);
  }
  return children;
}

std::string TextOf(const Element& element) {
  const std::string text = element.GetText() ? element.GetText() : "";
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
}

/// Parses the whole `text` as a finite number.
std::optional<double> ToNumber(const std::string& text) {
  double value = 0;
  std::size_t read = 0;
  try {
    value = std::stod(text, &read);
  } catch (const std::logic_error&) {
    return std::nullopt;
  }
  if (read != text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The drives of one URDF.
class DriveReader {
 public:
  DriveReader(const ConfigMap& config, const std::filesystem::path& file, MachineParts* parts)
      : config_(config), file_(file.filename().string()), parts_(*parts) {
    for (const auto& [name, map] : config.NamedMaps("actuators")) {
      ActuatorLimits& limits = actuators_[name];
      if (const auto rate = map.OptionalNumber("max_rate_degps", Positive("deg/s"))) {
        limits.max_rate_radps = *rate * kDeg;
      }
      limits.max_effort_nm = map.OptionalNumber("max_effort_nm", Positive("N m"));
    }
  }

  void Read(const Element& robot) {
    for (const Element* e : Children(robot, "transmission")) ReadTransmission(*e);
    for (const Element* system : Children(robot, "ros2_control")) {
      for (const Element* e : Children(*system, "joint")) ReadCommandInterfaces(*e);
      for (const Element* e : Children(*system, "transmission")) ReadTransmission(*e);
    }
    if (!parts_.driven.empty()) FreeTheOthers();
    CheckActuatorsUsed();
  }

 private:
  PartPlace Place(const Element& element, std::string_view what) const {
    return {config_, fmt::format("{} '{}' of {}:{}", what, Attribute(element, "name"), file_,
                                 element.GetLineNum())};
  }

  JointPart* FindJoint(const std::string& name) {
    const auto found = std::find_if(parts_.joints.begin(), parts_.joints.end(),
                                    [&](const JointPart& p) { return p.joint.name == name; });
    return found == parts_.joints.end() ? nullptr : &*found;
  }

  /// The movable joint named by `element`; null after a fault.
  JointPart* MovableJoint(const Element& element, const PartPlace& place) {
    const std::string name = MadePlain(Attribute(element, "name"));
    JointPart* part = FindJoint(name);
    if (!part) {
      std::vector<std::string> known;
      for (const JointPart& p : parts_.joints) known.push_back(p.joint.name);
      place.Fault("joint", {FaultKind::kNoSuchName, fmt::format("the URDF has no joint '{}'{}",
                                                                name, DidYouMean(name, known))});
    } else if (part->joint.type == JointType::kFixed) {
      place.Fault("joint", fmt::format("joint '{}' is fixed, which nothing can drive", name));
      return nullptr;
    }
    return part;
  }

  void AddDriven(const JointPart& part) {
    const std::string& joint = part.joint.name;
    auto& driven = parts_.driven;
    if (!part.leader.empty()) {
      parts_.remarks.push_back(
          fmt::format("joint '{}' follows '{}', and so has no lever, though "
                      "{} drives it",
                      joint, part.leader, file_));
    } else if (std::find(driven.begin(), driven.end(), joint) == driven.end())
      driven.push_back(joint);
  }

  void ReadTransmission(const Element& element) {
    const PartPlace place = Place(element, "transmission");
    if (!CheckType(element, place)) return;
    const auto joints = Children(element, "joint"), actuators = Children(element, "actuator");
    if (joints.size() != 1 || actuators.size() != 1) {
      place.Fault("joint",
                  {FaultKind::kUnsupported,
                   fmt::format("{} joints and {} actuators; need one of each (differential and "
                               "four-bar transmissions are not supported)",
                               joints.size(), actuators.size())});
      return;
    }
    CheckInterface(*joints[0], place);
    CheckInterface(*actuators[0], place);
    JointPart* part = MovableJoint(*joints[0], place);
    const double reduction = Reduction({joints[0], actuators[0]}, place);
    const auto limits = actuators_.find(Attribute(*actuators[0], "name"));
    if (limits != actuators_.end()) limits->second.used = true;
    actuator_names_.push_back(Attribute(*actuators[0], "name"));
    if (!part) return;
    const auto [first, is_new] = transmission_of_.emplace(part->joint.name, place.part);
    if (!is_new) {
      place.Fault("joint", {FaultKind::kRepeated, fmt::format("joint '{}' is driven by {} already",
                                                              part->joint.name, first->second)});
    }
    if (limits != actuators_.end()) NarrowByActuator(limits->second, reduction, &part->joint);
    AddDriven(*part);
  }

  /// Reads the type from `type` (ROS 1) or `plugin` (ROS 2). Without either, the type is simple.
  static bool CheckType(const Element& element, const PartPlace& place) {
    for (const char* key : {"type", "plugin"}) {
      for (const Element* stated : Children(element, key)) {
        std::string type = TextOf(*stated);
        if (const std::size_t slash = type.rfind('/'); slash != std::string::npos) {
          type = type.substr(slash + 1);
        }
        if (type == "SimpleTransmission") continue;
        place.Fault(
            key, {FaultKind::kUnsupported, fmt::format("'{}' is not supported; need "
                                                       "transmission_interface/SimpleTransmission",
                                                       TextOf(*stated))});
        return false;
      }
    }
    return true;
  }

  /// Reads `mechanicalReduction` in the actuator (ROS 1) or `mechanical_reduction` in the joint
  /// (ROS 2).
  double Reduction(const std::vector<const Element*>& elements, const PartPlace& place) {
    for (const Element* element : elements) {
      for (const char* key : {"mechanicalReduction", "mechanical_reduction"}) {
        const Element* stated = element->FirstChildElement(key);
        if (!stated) continue;
        const auto number = ToNumber(TextOf(*stated));
        if (number && *number != 0) return std::abs(*number);
        place.Fault(key, {FaultKind::kMistyped,
                          fmt::format("'{}'; need a number that is not zero", TextOf(*stated))});
      }
    }
    return 1.0;
  }

  void CheckInterface(const Element& element, const PartPlace& place) {
    for (const Element* stated : Children(element, "hardwareInterface")) {
      std::string name = TextOf(*stated);
      if (const std::size_t slash = name.rfind('/'); slash != std::string::npos) {
        name = name.substr(slash + 1);
      }
      if (std::find(kInterfaces.begin(), kInterfaces.end(), name) != kInterfaces.end()) continue;
      place.Fault("hardwareInterface",
                  {FaultKind::kNoSuchName, fmt::format("'{}' is not known, need one of {}", name,
                                                       fmt::join(kInterfaces, ", "))});
    }
  }

  static void NarrowByActuator(const ActuatorLimits& limits, double reduction, Joint* joint) {
    if (limits.max_rate_radps) {
      const double rate = *limits.max_rate_radps / reduction;
      Narrow(rate, &joint->max_rate_positive_radps);
      Narrow(rate, &joint->max_rate_negative_radps);
    }
    if (limits.max_effort_nm) Narrow(*limits.max_effort_nm * reduction, &joint->max_effort_nm);
  }

  /// A value of zero means that no limit is given.
  static void Narrow(double limit, double* value) {
    *value = *value > 0 ? std::min(*value, limit) : limit;
  }

  void ReadCommandInterfaces(const Element& element) {
    const PartPlace place = Place(element, "ros2_control joint");
    JointPart* part = MovableJoint(element, place);
    const auto interfaces = Children(element, "command_interface");
    if (!part || interfaces.empty()) return;
    for (const Element* interface : interfaces) NarrowByInterface(*interface, place, &part->joint);
    AddDriven(*part);
  }

  void NarrowByInterface(const Element& interface, const PartPlace& place, Joint* joint) {
    const std::string name = Attribute(interface, "name");
    if (name != "position" && name != "velocity" && name != "effort") {
      place.Fault("command_interface",
                  {FaultKind::kNoSuchName,
                   fmt::format("'{}' is not known, need position, velocity or effort", name)});
      return;
    }
    const auto lower = Parameter(interface, "min", name, place);
    const auto upper = Parameter(interface, "max", name, place);
    if (lower && upper && *lower >= *upper) {
      place.Fault(name, fmt::format("min {} is not below max {}", *lower, *upper));
    } else if (name == "position") {
      if (joint->type == JointType::kContinuous) return;
      if (lower) joint->lower_rad = std::clamp(*lower, joint->lower_rad, joint->upper_rad);
      if (upper) joint->upper_rad = std::clamp(*upper, joint->lower_rad, joint->upper_rad);
      joint->initial_rad = std::clamp(joint->initial_rad, joint->lower_rad, joint->upper_rad);
    } else if ((lower && *lower >= 0) || (upper && *upper <= 0)) {
      place.Fault(name, "need min below and max above zero");
    } else if (name == "velocity") {
      if (upper) Narrow(*upper, &joint->max_rate_positive_radps);
      if (lower) Narrow(-*lower, &joint->max_rate_negative_radps);
    } else {
      if (upper) Narrow(*upper, &joint->max_effort_nm);
      if (lower) Narrow(-*lower, &joint->max_effort_nm);
    }
  }

  std::optional<double> Parameter(const Element& interface, std::string_view key,
                                  const std::string& name, const PartPlace& place) {
    for (const Element* stated : Children(interface, "param")) {
      if (Attribute(*stated, "name") != key) continue;
      const auto number = ToNumber(TextOf(*stated));
      if (!number) {
        place.Fault(name, {FaultKind::kMistyped,
                           fmt::format("{} is '{}', need a number", key, TextOf(*stated))});
      }
      return number;
    }
    return std::nullopt;
  }

  void FreeTheOthers() {
    for (JointPart& part : parts_.joints) {
      const auto& driven = parts_.driven;
      if (std::find(driven.begin(), driven.end(), part.joint.name) != driven.end()) continue;
      part.joint.max_effort_nm = 0;
    }
  }

  void CheckActuatorsUsed() {
    for (const auto& [name, limits] : actuators_) {
      if (limits.used) continue;
      config_.Fault("actuators", {FaultKind::kNoSuchName,
                                  fmt::format("no transmission of the URDF has an actuator '{}'{}",
                                              name, DidYouMean(name, actuator_names_))});
    }
  }

  const ConfigMap& config_;
  const std::string file_;
  MachineParts& parts_;
  std::map<std::string, ActuatorLimits> actuators_;
  std::vector<std::string> actuator_names_;
  std::map<std::string, std::string> transmission_of_;  ///< by joint name
};

}  // namespace

void ReadUrdfDrives(const ConfigMap& config, const std::filesystem::path& file,
                    const Element& robot, MachineParts* parts) {
  DriveReader(config, file, parts).Read(robot);
}

void CheckDriven(const MachineParts& parts) {
  for (const JointPart& part : parts.joints) {
    const Joint& joint = part.joint;
    if (std::find(parts.driven.begin(), parts.driven.end(), joint.name) == parts.driven.end()) {
      continue;
    }
    const auto require = [&](double value, std::string_view what, std::string_view key) {
      if (value > 0) return;
      part.place.Fault(what, fmt::format("it is driven but has no {} limit; give it in <limit>, or "
                                         "{} in `joints:`",
                                         what, key));
    };
    const bool linear = joint.type == JointType::kPrismatic;
    require(std::min(joint.max_rate_positive_radps, joint.max_rate_negative_radps), "velocity",
            linear ? "max_rate_mps" : "max_rate_degps");
    require(joint.max_effort_nm, "effort", linear ? "max_effort_n" : "max_effort_nm");
  }
}

}  // namespace tera
