#include "ros2/state_publisher.h"

#include "ros2/names.h"

namespace tera::ros {
namespace {

void Append(const std::vector<TransformStamped>& more, TfMessage* message) {
  message->transforms.insert(message->transforms.end(), more.begin(), more.end());
}

}  // namespace

StatePublisher::StatePublisher(const Scenario& scenario, const WorldState& start,
                               Participant* participant)
    : scenario_(scenario),
      participant_(participant),
      clock_(participant->Advertise<Clock>("/clock", Delivery::kClock)),
      tf_(participant->Advertise<TfMessage>("/tf", Delivery::kTransforms)) {
  TfMessage unmoving;
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) {
    const ScenarioMachine& machine = scenario.machines[m];
    const auto topic = [&](const std::string& name) {
      return TopicOf(machine.placement.name, name);
    };
    Topics topics;
    topics.odom = participant->Advertise<Odometry>(topic("odom"), Delivery::kState);
    topics.joint_states =
        participant->Advertise<JointState>(topic("joint_states"), Delivery::kState);
    if (!machine.placement.model.cylinders.empty()) {
      topics.cylinders = participant->Advertise<JointState>(topic("cylinders"), Delivery::kState);
    }
    topics.tool = EndEffectorOf(machine.placement.model);
    if (topics.tool) {
      topics.ee_pose = participant->Advertise<PoseStamped>(topic("ee_pose"), Delivery::kState);
      topics.bucket_mass = participant->Advertise<Float64>(topic("bucket_mass"), Delivery::kState);
    }
    topics_.push_back(topics);
    Append(StaticTransforms(start.t_ns, machine, start.machines[m]), &unmoving);
  }
  const auto tf_static = participant->Advertise<TfMessage>("/tf_static", Delivery::kLatched);
  participant->Publish(tf_static, unmoving);
}

void StatePublisher::Publish(const WorldState& state) {
  now_ns_ = state.t_ns;
  TfMessage moving;
  for (std::size_t m = 0; m < topics_.size(); ++m) {
    const Topics& topics = topics_[m];
    const ScenarioMachine& machine = scenario_.machines[m];
    const MachineState& now = state.machines[m];
    participant_->Publish(topics.odom, OdometryMessage(now_ns_, machine, now));
    participant_->Publish(topics.joint_states, JointStateMessage(now_ns_, machine, now));
    if (topics.cylinders >= 0) {
      participant_->Publish(topics.cylinders, CylindersMessage(now_ns_, machine, now));
    }
    if (topics.tool) {
      participant_->Publish(topics.ee_pose,
                            EndEffectorMessage(now_ns_, machine, now, *topics.tool));
      participant_->Publish(topics.bucket_mass, BucketMassMessage(now, *topics.tool));
    }
    Append(MovingTransforms(now_ns_, machine, now), &moving);
  }
  participant_->Publish(tf_, moving);
  RepeatClock();
}

void StatePublisher::RepeatClock() { participant_->Publish(clock_, Clock{now_ns_}); }

}  // namespace tera::ros
