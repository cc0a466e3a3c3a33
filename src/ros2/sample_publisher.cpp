#include "ros2/sample_publisher.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "ros2/from_samples.h"
#include "ros2/names.h"

namespace tera::ros {
namespace {

// Topics of a sensor, below its own; empty: the sensor's own.
const std::string kOwn;
const std::string kFix = "fix";
const std::string kPoints = "points";
const std::string kColour = "image_raw", kCameraInfo = "camera_info";
const std::string kDepth = "depth/image_raw", kDepthInfo = "depth/camera_info";
const std::string kSemantic = "semantic/image_raw", kInstance = "instance/image_raw";

std::string MachineOf(const std::string& folder) { return folder.substr(0, folder.find('/')); }

}  // namespace

SamplePublisher::SamplePublisher(const Scenario& scenario, Participant* participant)
    : participant_(participant) {
  for (const ScenarioMachine& machine : scenario.machines) {
    for (const SensorDescription& sensor : machine.sensors) {
      sensors_[machine.placement.name + "/" + sensor.name] = sensor;
    }
  }
}

void SamplePublisher::PublishDue(TimeNs now_ns) {
  while (!outgoing_.empty() && outgoing_.begin()->first <= now_ns) {
    const Outgoing& next = outgoing_.begin()->second;
    participant_->Publish(next.writer, next.message);
    outgoing_.erase(outgoing_.begin());
  }
}

SamplePublisher::Channel SamplePublisher::ChannelOf(const std::string& folder) const {
  const SensorDescription& sensor = sensors_.at(folder);
  return {sensor, FrameOf(MachineOf(folder), sensor.name), {}, {}};
}

template <typename M>
void SamplePublisher::AddTopic(const std::string& folder, const std::string& below,
                               Delivery delivery, Channel* channel) {
  std::string topic = TopicOf(MachineOf(folder), TopicOf(channel->sensor));
  if (!below.empty()) topic += "/" + below;
  channel->topics[below] = participant_->Advertise<M>(topic, delivery);
}

ChannelId SamplePublisher::Add(Channel channel) {
  channels_.push_back(std::move(channel));
  return static_cast<ChannelId>(channels_.size()) - 1;
}

ChannelId SamplePublisher::AddImu(const std::string& folder, const std::string&) {
  Channel channel = ChannelOf(folder);
  AddTopic<Imu>(folder, kOwn, Delivery::kSensorData, &channel);
  return Add(std::move(channel));
}

ChannelId SamplePublisher::AddGnss(const std::string& folder, const std::string&) {
  Channel channel = ChannelOf(folder);
  AddTopic<NavSatFix>(folder, kFix, Delivery::kSensorData, &channel);
  return Add(std::move(channel));
}

ChannelId SamplePublisher::AddEncoder(const std::string& folder, const std::string&,
                                      const std::vector<EncoderAxis>& axes) {
  Channel channel = ChannelOf(folder);
  for (const EncoderAxis& axis : axes) channel.axes.push_back(axis.name);
  AddTopic<JointState>(folder, kOwn, Delivery::kSensorData, &channel);
  return Add(std::move(channel));
}

ChannelId SamplePublisher::AddCamera(const std::string& folder, const std::string&) {
  Channel channel = ChannelOf(folder);
  const CameraModel& camera = std::get<CameraModel>(channel.sensor.model);
  channel.frame_id = OpticalFrameOf(MachineOf(folder), channel.sensor.name);
  AddTopic<CameraInfo>(folder, kCameraInfo, Delivery::kLarge, &channel);
  if (camera.rgb) AddTopic<Image>(folder, kColour, Delivery::kLarge, &channel);
  if (camera.depth) {
    AddTopic<Image>(folder, kDepth, Delivery::kLarge, &channel);
    AddTopic<CameraInfo>(folder, kDepthInfo, Delivery::kLarge, &channel);
  }
  if (camera.labels) {
    AddTopic<Image>(folder, kSemantic, Delivery::kLarge, &channel);
    AddTopic<Image>(folder, kInstance, Delivery::kLarge, &channel);
  }
  return Add(std::move(channel));
}

ChannelId SamplePublisher::AddLidar(const std::string& folder, const std::string&) {
  Channel channel = ChannelOf(folder);
  AddTopic<PointCloud2>(folder, kPoints, Delivery::kLarge, &channel);
  return Add(std::move(channel));
}

ChannelId SamplePublisher::AddTable(const std::string&, const std::vector<std::string>&) {
  return Add({});
}

ChannelId SamplePublisher::AddPose(const std::string&, bool) { return Add({}); }

template <typename Make>
void SamplePublisher::Send(const Channel& channel, const std::string& topic, TimeNs at_ns,
                           const Make& make) {
  const auto writer = channel.topics.find(topic);
  if (writer == channel.topics.end() || !participant_->HasReaders(writer->second)) return;
  outgoing_.emplace(at_ns, Outgoing{writer->second, make()});
}

void SamplePublisher::Write(ChannelId id, const ImuSample& sample) {
  const Channel& channel = channels_.at(id);
  const double period_s = 1 / channel.sensor.clock.rate_hz;
  Send(channel, kOwn, sample.t_available_ns, [&] {
    return ImuMessage(sample, channel.frame_id, std::get<ImuModel>(channel.sensor.model), period_s);
  });
}

void SamplePublisher::Write(ChannelId id, const GnssSample& sample) {
  const Channel& channel = channels_.at(id);
  Send(channel, kFix, sample.t_available_ns,
       [&] { return NavSatFixMessage(sample, channel.frame_id); });
}

void SamplePublisher::Write(ChannelId id, const EncoderSample& sample) {
  const Channel& channel = channels_.at(id);
  Send(channel, kOwn, sample.t_available_ns,
       [&] { return JointStateMessage(sample, channel.frame_id, channel.axes); });
}

void SamplePublisher::Write(ChannelId id, CameraFrame frame) {
  const Channel& channel = channels_.at(id);
  const auto send = [&](const std::string& topic, const auto& make) {
    Send(channel, topic, frame.t_available_ns, make);
  };
  const auto info = [&] {
    return CameraInfoMessage({frame.t_ns, channel.frame_id},
                             std::get<CameraModel>(channel.sensor.model).intrinsics);
  };
  send(kColour, [&] { return ColourMessage(frame, channel.frame_id); });
  send(kCameraInfo, info);
  send(kDepth, [&] { return DepthMessage(frame, channel.frame_id); });
  send(kDepthInfo, info);
  send(kSemantic, [&] { return SemanticMessage(frame, channel.frame_id); });
  send(kInstance, [&] { return InstanceMessage(frame, channel.frame_id); });
}

void SamplePublisher::Write(ChannelId id, LidarScan scan) {
  const Channel& channel = channels_.at(id);
  Send(channel, kPoints, scan.t_available_ns,
       [&] { return PointCloudMessage(scan, channel.frame_id); });
}

void SamplePublisher::Write(ChannelId, const TruthPose&) {}

void SamplePublisher::WriteRow(ChannelId, TimeNs, const std::vector<double>&) {}

bool SamplePublisher::NeedsFrame(ChannelId id, TimeNs, TimeNs) const {
  const auto& topics = channels_.at(id).topics;
  return std::any_of(topics.begin(), topics.end(),
                     [&](const auto& topic) { return participant_->HasReaders(topic.second); });
}

void SamplePublisher::MarkPresent(ChannelId, TimeNs) {}

}  // namespace tera::ros
