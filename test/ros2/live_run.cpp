#include "ros2/live_run.h"

#include <gtest/gtest.h>

#include "core/config/config.h"

namespace tera {

const char* const kTwoMachines = R"(
name: two
seed: 5
duration_s: 1
settle_s: 1.5
site: {lat_deg: 47.5, lon_deg: 8.5, height_m: 460}
terrain: {size_m: [20, 20], cell_m: 0.1, soil: dirt}
machines:
  - name: red
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-4, 1], yaw_deg: 30}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3], rate_hz: 100},
      {name: gnss_left, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2]},
      {name: camera, preset: tera:config/sensors/realsense_d435i.yaml, link: upper, xyz_m: [0.8, 0.3, 1.8], rpy_deg: [0, 30, 0], width_px: 64, height_px: 48, rate_hz: 5},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1], columns: 128},
      {name: encoders, preset: tera:config/sensors/encoder.yaml}]}
  - name: blue
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [4, 2], yaw_deg: -100}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu_arm, preset: tera:config/sensors/xsens_mti_670.yaml, link: arm, xyz_m: [0.2, 0, 0.1], rate_hz: 100}]}
)";

BackgroundRun::BackgroundRun(ros::LiveRosOptions options) : options_(std::move(options)) {
  options_.dds = {.domain_id = OwnDomainId(), .this_host_only = true};
  options_.stop = [this] { return stop_.load(); };
  options_.log = [this](const std::string& line) {
    const std::lock_guard lock(mutex_);
    log_.push_back(line);
  };
  thread_ = std::thread([this] { Run(); });
}

ros::LiveRosReport BackgroundRun::End() {
  stop_ = true;
  return Wait();
}

ros::LiveRosReport BackgroundRun::Wait() {
  if (thread_.joinable()) thread_.join();
  return report_;
}

std::vector<std::string> BackgroundRun::log() {
  const std::lock_guard lock(mutex_);
  return log_;
}

void BackgroundRun::Run() {
  const Config config = Config::FromText(kTwoMachines, "two.yaml");
  auto scenario = std::make_shared<const Scenario>(ReadScenario(config.root()));
  config.Finish();
  report_ = ros::RunForRos(std::move(scenario), config.ResolvedYaml(), options_);
}

const FastPeer::Wish kClock{.topic = "rt/clock", .type = "rosgraph_msgs::msg::dds_::Clock_"};

FastPeer::Wish JointStatesOf(const std::string& machine) {
  return {.topic = "rt/" + machine + "/joint_states",
          .type = "sensor_msgs::msg::dds_::JointState_",
          .reliable = true};
}

FastPeer::Wish LeversOf(const std::string& machine) {
  return {.topic = "rt/" + machine + "/delta_can",
          .type = "tera_msgs::msg::dds_::DeltaCAN_",
          .reliable = true};
}

TimeNs ClockOf(const Payload& payload) { return CdrReader(payload).Time(); }

JointView JointsOf(const Payload& payload) {
  CdrReader cdr(payload);
  JointView view;
  view.t_ns = cdr.Time();
  cdr.Text();
  const auto names = cdr.Get<std::vector<std::string>>();
  const auto position = cdr.Get<std::vector<double>>(), velocity = cdr.Get<std::vector<double>>(),
             effort = cdr.Get<std::vector<double>>();
  EXPECT_TRUE(cdr.AtEnd());
  for (std::size_t i = 0; i < names.size(); ++i) {
    view.position[names[i]] = position.at(i);
    view.velocity[names[i]] = velocity.at(i);
    view.effort[names[i]] = effort.at(i);
  }
  return view;
}

/// The payload, or an empty one after a failure.
Payload Require(const std::optional<Payload>& payload, const std::string& what) {
  EXPECT_TRUE(payload.has_value()) << what;
  return payload.value_or(Payload{0, 1, 0, 0});
}

LeverMessage AnswerTo(TimeNs t_ns) {
  return {.stamp_sec = static_cast<std::int32_t>(t_ns / kNsPerSecond),
          .stamp_nanosec = static_cast<std::uint32_t>(t_ns % kNsPerSecond)};
}

}  // namespace tera
