#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/units.h"
#include "sim/operators/dig_cycle.h"

namespace tera {
namespace {

constexpr double kMostCycles = 1e6;
constexpr double kLayer_m = 0.12;  ///< depth of a compact machine's pull along a trench
constexpr double kPull_mps =
    0.5;  ///< speed of a pull, at which the tip follows the design within centimetres
constexpr double kClearOfHeap_deg =
    35;  ///< angle from the centre of a heap to its foot, seen from the slew axis
constexpr double kLeastArm_m = 1e-3;  ///< smallest distance between two pins of the arm

/// Whether `link` is a descendant of `ancestor`.
bool HangsOn(const MachineModel& model, int link, int ancestor) {
  while (link > 0 && link != ancestor) link = model.joints[link - 1].parent;
  return link == ancestor;
}

/// Reports joints without a lever; true if there is nothing to report.
bool CheckLevers(const ConfigMap& config, const MachineModel& model, const DigPlan& plan) {
  const std::pair<std::string_view, int> needed[] = {{"slew", plan.joints.slew},
                                                     {"boom", plan.joints.boom},
                                                     {"arm", plan.joints.arm},
                                                     {"bucket", plan.joints.bucket}};
  bool good = true;
  for (const auto& [key, joint] : needed) {
    const int index = joint;
    if (std::ranges::any_of(model.levers, [=](const Lever& l) { return l.joint == index; })) {
      continue;
    }
    config.Fault(config.Has(key) ? key : "type",
                 {FaultKind::kNoSuchName,
                  fmt::format("machine '{}' has no lever that moves joint '{}'; a dig cycle needs "
                              "one each for slew, boom, arm and bucket",
                              model.kind, model.joints[index].name)});
    good = false;
  }
  return good;
}

/// Reports joints that do not form a planar arm on a slewing base. True if there is nothing to
/// report.
bool CheckArm(const ConfigMap& config, const MachineModel& model, const DigPlan& plan) {
  bool good = true;
  const auto fault = [&](std::string_view key, const InputFault& found) {
    config.Fault(key, found);
    good = false;
  };
  const auto at = [&](int joint) -> const Joint& { return model.joints[joint]; };
  const auto check_turns = [&](std::string_view key, const Joint& joint) {
    if (joint.type == JointType::kRevolute || joint.type == JointType::kContinuous) return;
    fault(key, fmt::format("joint '{}' does not turn; need a revolute joint", joint.name));
  };
  const auto check_carries = [&](std::string_view key, const Joint& joint, const Joint& next) {
    if (next.parent != joint.child) {
      fault(key, fmt::format("joint '{}' does not carry joint '{}'; need boom, arm and bucket "
                             "joints that hang on one another",
                             joint.name, next.name));
    } else if (next.X_PJ.translation().norm() < kLeastArm_m) {
      fault(key, fmt::format("the pins of joints '{}' and '{}' coincide; need an arm between them",
                             joint.name, next.name));
    }
  };
  const Joint &slew = at(plan.joints.slew), &boom = at(plan.joints.boom);
  const Joint &arm = at(plan.joints.arm), &bucket = at(plan.joints.bucket);
  check_turns("slew", slew);
  check_turns("boom", boom);
  check_turns("arm", arm);
  check_turns("bucket", bucket);
  if (!HangsOn(model, boom.parent, slew.child)) {
    fault("slew", fmt::format("joint '{}' does not turn the boom; need the joint of the upper "
                              "structure",
                              slew.name));
  }
  check_carries("boom", boom, arm);
  check_carries("arm", arm, bucket);
  const NamedFrame& tip = model.frames[plan.tip_frame];
  if (tip.link != bucket.child) {
    fault(config.Has("tip_frame") ? "tip_frame" : "bucket",
          fmt::format(
              "joint '{}' moves link '{}' but frame '{}' is fixed to link '{}'; need both on "
              "one link",
              bucket.name, model.links[bucket.child].name, tip.name, model.links[tip.link].name));
  }
  return good;
}

/// Reads `blade`: the joint of a blade, which must have a lever. -1 without the key.
int ReadBlade(const ConfigMap& config, const MachineModel& model) {
  const std::string name = config.Text("blade", "blade");
  const int joint = model.JointIndex(name);
  const bool has_lever = joint >= 0 && std::ranges::any_of(model.levers, [&](const Lever& l) {
                           return l.joint == joint;
                         });
  if (has_lever) return joint;
  if (name != "blade") {
    config.Fault("blade", {FaultKind::kNoSuchName,
                           fmt::format("machine '{}' has no joint '{}' with a lever; name the "
                                       "joint of its blade, or remove the key",
                                       model.kind, name)});
  }
  return -1;
}

/// Reads the place and the number of dig cycles.
void ReadPlace(const ConfigMap& config, DigPlan* plan) {
  const Range azimuth = Between(-360, 360, "deg");
  plan->dig_azimuth_rad = config.Number("dig_azimuth_deg", azimuth, 0) * kDeg;
  plan->azimuth_step_rad = config.Number("azimuth_step_deg", azimuth, 0) * kDeg;
  plan->reach_m = config.Number("reach_m", Positive("m"), plan->reach_m);
  plan->cut_length_m = config.Number("cut_length_m", Positive("m"), plan->cut_length_m);
  plan->cycles = static_cast<int>(config.Integer("cycles", Between(0, kMostCycles, ""), 0));
  if (plan->cut_length_m >= plan->reach_m) {
    config.Fault("cut_length_m", {FaultKind::kOutOfRange,
                                  "the cut would pass the slew axis, need less than reach_m"});
  }
}

}  // namespace

std::optional<DigPlan> ReadDigPlan(const ConfigMap& config, const MachineModel& model,
                                   bool to_design) {
  DigPlan plan;
  plan.to_design = to_design;
  if (to_design) {
    plan.tracks = ReadSkidSteerLevers(config, model);
    plan.blade = ReadBlade(config, model);
  }
  const auto joint = [&](std::string_view key) {
    const std::string name = config.Text(key, key);
    const int index = model.JointIndex(name);
    if (index < 0) {
      config.Fault(key, {FaultKind::kNoSuchName,
                         "machine '" + model.kind + "' has no joint '" + name +
                             "'; a dig cycle needs slew, boom, arm and bucket joints"});
    }
    return index;
  };
  plan.joints = {joint("slew"), joint("boom"), joint("arm"), joint("bucket")};
  const std::string tip = config.Text("tip_frame", "bucket_tip");
  for (std::size_t i = 0; i < model.frames.size(); ++i) {
    if (model.frames[i].name == tip) plan.tip_frame = static_cast<int>(i);
  }
  if (plan.tip_frame < 0)
    config.Fault("tip_frame", {FaultKind::kNoSuchName, "the machine has no frame '" + tip + "'"});

  const auto& shovels = model.ground_tools.shovels;
  for (std::size_t s = 0; s < shovels.size() && plan.joints.bucket >= 0; ++s) {
    if (shovels[s].link == model.joints[plan.joints.bucket].child)
      plan.shovel = static_cast<int>(s);
  }
  if (plan.joints.bucket >= 0 && plan.shovel < 0) {
    config.Fault("bucket",
                 {FaultKind::kMissing, "the link that this joint moves carries no shovel"});
  }

  if (!to_design) ReadPlace(config, &plan);
  plan.dump_azimuth_rad = config.Number("dump_azimuth_deg", Between(-360, 360, "deg"), 80) * kDeg;
  plan.cut_depth_m =
      config.Number("cut_depth_m", AtLeast(0, "m"), to_design ? kLayer_m : plan.cut_depth_m);
  plan.cut_speed_mps =
      config.Number("cut_speed_mps", Positive("m/s"), to_design ? kPull_mps : plan.cut_speed_mps);
  plan.dump_reach_m = config.Number("dump_reach_m", Positive("m"), plan.dump_reach_m);
  plan.dump_height_m = config.Number("dump_height_m", Positive("m"), plan.dump_height_m);
  plan.clear_dump_rad =
      config.Number("clear_dump_deg", Between(0, 180, "deg"), to_design ? kClearOfHeap_deg : 0) *
      kDeg;
  plan.slew_braking_radps2 =
      config.Number("slew_braking_degps2", AtLeast(0, "deg/s2"), plan.slew_braking_radps2) * kDeg;
  plan.servo_gain_1ps = config.Number("servo_gain_1ps", Positive("1/s"), plan.servo_gain_1ps);
  plan.patience_s = config.Number("patience_s", Positive("s"), plan.patience_s);

  const bool complete = plan.joints.slew >= 0 && plan.joints.boom >= 0 && plan.joints.arm >= 0 &&
                        plan.joints.bucket >= 0 && plan.tip_frame >= 0 && plan.shovel >= 0;
  if (!complete || !CheckArm(config, model, plan) || !CheckLevers(config, model, plan)) {
    return std::nullopt;
  }
  return plan;
}

}  // namespace tera
