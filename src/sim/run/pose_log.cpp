#include "sim/run/pose_log.h"

#include <utility>

#include "core/types/sample_rows.h"
#include "sensors/sensor.h"

namespace tera {

namespace {

constexpr double kDynamicObstacles_hz = 50;  ///< if the scenario gives no rate

}  // namespace

PoseLog::PoseLog(const Scenario& scenario, MeasurementSink* sink) : sink_(sink) {
  clock_.rate_hz = scenario.poses_hz.value_or(kDynamicObstacles_hz);
  for (std::size_t m = 0; scenario.poses_hz && m < scenario.machines.size(); ++m) {
    FollowMachine(scenario.machines[m], m);
  }
  for (std::size_t o = 0; o < scenario.obstacles.size(); ++o) {
    const ScenarioObstacle& obstacle = scenario.obstacles[o];
    const bool on_path = scenario.poses_hz && !obstacle.path.empty();
    if (!on_path && !obstacle.dynamic) continue;
    Follow(
        "truth/" + obstacle.name + "/pose.csv",
        [o](const Instant& now) -> const Pose& { return now.obstacles[o].X_WB; }, Pose::Identity());
  }
}

void PoseLog::FollowMachine(const ScenarioMachine& machine, std::size_t m) {
  const MachineModel& model = machine.placement.model;
  const std::string folder = "truth/" + machine.placement.name;
  const auto link_pose = [m](int link) {
    return [m, link](const Instant& now) -> const Pose& {
      return now.machines[m].links[static_cast<std::size_t>(link)].X_WB;
    };
  };
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    Follow(folder + "/links/" + model.links[l].name + ".csv", link_pose(static_cast<int>(l)),
           Pose::Identity());
  }
  for (const SensorDescription& sensor : machine.sensors) {
    if (sensor.link.empty()) continue;
    const std::string file = folder + "/sensors/" + sensor.name;
    const Mounting is = TrueMounting(sensor, machine.sensors);
    Follow(file + ".csv", link_pose(model.LinkIndex(is.link)), is.X_BT);
    if (is.link == sensor.link && is.X_BT.matrix() == sensor.X_BS.matrix()) continue;
    Follow(file + ".documented.csv", link_pose(model.LinkIndex(sensor.link)), sensor.X_BS);
  }
}

void PoseLog::Follow(const std::string& file, std::function<const Pose&(const Instant&)> X_WB,
                     const Pose& X_BS) {
  followed_.push_back({sink_->AddChannel(PoseChannel(file, false)), std::move(X_WB), X_BS});
}

void PoseLog::Write(const Instant& before, const Instant& after) {
  if (followed_.empty()) return;
  for (; clock_.Due(next_) <= after.t_ns; ++next_) {
    const TimeNs t_ns = clock_.Due(next_);
    const double s = after.t_ns == before.t_ns ? 1.0
                                               : static_cast<double>(t_ns - before.t_ns) /
                                                     static_cast<double>(after.t_ns - before.t_ns);
    for (const Followed& one : followed_) {
      const Pose X_WB = Interpolate(one.X_WB(before), one.X_WB(after), s);
      sink_->Write(one.channel, RowOf(TruthPose{t_ns, X_WB * one.X_BS, {}, {}}, false));
    }
  }
}

}  // namespace tera
