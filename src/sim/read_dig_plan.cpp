#include "core/units.h"
#include "sim/dig_cycle.h"

namespace tera {

DigPlan ReadDigPlan(const ConfigMap& config, const MachineModel& model) {
  DigPlan plan;
  const auto joint = [&](std::string_view key) {
    const std::string name = config.Text(key, key);
    const int index = model.JointIndex(name);
    if (index < 0) {
      config.Fault(key, "machine '" + model.kind + "' has no joint '" + name +
                            "'; a dig cycle needs slew, boom, arm and bucket joints");
    }
    return index;
  };
  plan.joints = {joint("slew"), joint("boom"), joint("arm"), joint("bucket")};
  const std::string tip = config.Text("tip_frame", "bucket_tip");
  for (std::size_t i = 0; i < model.frames.size(); ++i) {
    if (model.frames[i].name == tip) plan.tip_frame = static_cast<int>(i);
  }
  if (plan.tip_frame < 0) config.Fault("tip_frame", "the machine has no frame '" + tip + "'");

  const auto& shovels = model.ground_tools.shovels;
  for (std::size_t s = 0; s < shovels.size() && plan.joints.bucket >= 0; ++s) {
    if (shovels[s].link == model.joints[plan.joints.bucket].child)
      plan.shovel = static_cast<int>(s);
  }
  if (plan.joints.bucket >= 0 && plan.shovel < 0) {
    config.Fault("bucket", "the link that this joint moves carries no shovel");
  }

  const Range azimuth = Between(-360, 360, "deg");
  plan.dig_azimuth_rad = config.Number("dig_azimuth_deg", azimuth, 0) * kDeg;
  plan.azimuth_step_rad = config.Number("azimuth_step_deg", azimuth, 0) * kDeg;
  plan.dump_azimuth_rad = config.Number("dump_azimuth_deg", azimuth, 80) * kDeg;
  plan.reach_m = config.Number("reach_m", Positive("m"), plan.reach_m);
  plan.cut_length_m = config.Number("cut_length_m", Positive("m"), plan.cut_length_m);
  plan.cut_depth_m = config.Number("cut_depth_m", AtLeast(0, "m"), plan.cut_depth_m);
  plan.cut_speed_mps = config.Number("cut_speed_mps", Positive("m/s"), plan.cut_speed_mps);
  plan.dump_reach_m = config.Number("dump_reach_m", Positive("m"), plan.dump_reach_m);
  plan.dump_height_m = config.Number("dump_height_m", Positive("m"), plan.dump_height_m);
  plan.cycles = static_cast<int>(config.Integer("cycles", AtLeast(0, ""), 0));
  if (plan.cut_length_m >= plan.reach_m) {
    config.Fault("cut_length_m", "the cut would pass the slew axis, need less than reach_m");
  }
  return plan;
}

}  // namespace tera
