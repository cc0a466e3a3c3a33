#include "ros2/sample_publisher.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/check.h"
#include "core/types/sample_rows.h"
#include "dataset/ros/from_samples.h"
#include "ros2/names.h"
#include "sensors/camera/camera.h"
#include "sensors/camera/read_lens.h"
#include "sensors/imu/imu.h"

namespace tera::ros {
namespace {

ImuNoise NoiseOf(const ImuModel& model) {
  return {model.gyro_noise_density_radpsrthz, model.gyro_sample_noise_radps,
          model.accel_noise_density_mps2rthz, model.accel_sample_noise_mps2};
}

CameraLens LensOf(const CameraIntrinsics& c) {
  return {std::string(NameOf(c.kind)),
          c.width_px,
          c.height_px,
          c.fx_px,
          c.fy_px,
          c.cx_px,
          c.cy_px,
          c.k1,
          c.k2,
          c.p1,
          c.p2,
          c.k3,
          c.k4,
          c.k5,
          c.k6};
}

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

ChannelId SamplePublisher::AddChannel(const ChannelInfo& info) {
  using Add = void (SamplePublisher::*)(const ChannelInfo&, Channel*);
  static const std::map<std::string_view, Add> own = {{kImuChannel, &SamplePublisher::AddImu},
                                                      {kGnssChannel, &SamplePublisher::AddGnss}};
  Channel channel;
  if (info.sensor_yaml) {
    channel.sensor = sensors_.at(info.path);
    channel.machine = MachineOf(info.path);
    channel.frame_id = FrameOf(channel.machine, channel.sensor.name);
    Add add = &SamplePublisher::AddRows;
    if (const auto found = own.find(info.type); found != own.end()) add = found->second;
    if (info.form == ChannelForm::kPictures) add = &SamplePublisher::AddCamera;
    if (info.form == ChannelForm::kScans) add = &SamplePublisher::AddLidar;
    (this->*add)(info, &channel);
  }
  channels_.push_back(std::move(channel));
  return static_cast<ChannelId>(channels_.size()) - 1;
}

template <typename M>
void SamplePublisher::AddTopic(const std::string& below, Delivery delivery, Channel* channel) {
  std::string topic = TopicOf(channel->machine, TopicOf(channel->sensor));
  if (!below.empty()) topic += "/" + below;
  channel->topics[below] = participant_->Advertise<M>(topic, delivery);
}

template <typename M, typename MessageOf>
void SamplePublisher::AddRowTopic(const std::string& below, const MessageOf& message_of,
                                  Channel* channel) {
  AddTopic<M>(below, Delivery::kSensorData, channel);
  channel->row_topic = below;
  channel->row_message = message_of;
}

void SamplePublisher::AddImu(const ChannelInfo&, Channel* channel) {
  const auto message_of = [frame_id = channel->frame_id,
                           noise = NoiseOf(std::get<ImuModel>(channel->sensor.model)),
                           period_s = 1 / channel->sensor.clock.rate_hz](const RowSample& row) {
    return ImuMessage(ImuSampleOf(row), frame_id, noise, period_s);
  };
  AddRowTopic<Imu>(kSensorItself, message_of, channel);
}

void SamplePublisher::AddGnss(const ChannelInfo&, Channel* channel) {
  const auto message_of = [frame_id = channel->frame_id](const RowSample& row) {
    return NavSatFixMessage(GnssSampleOf(row), frame_id);
  };
  AddRowTopic<NavSatFix>(kFixTopic, message_of, channel);
}

void SamplePublisher::AddRows(const ChannelInfo& info, Channel* channel) {
  const auto message_of = [frame_id = channel->frame_id,
                           columns = info.columns](const RowSample& row) {
    return JointStateOfRow(row, frame_id, columns);
  };
  AddRowTopic<JointState>(kSensorItself, message_of, channel);
}

void SamplePublisher::AddCamera(const ChannelInfo&, Channel* channel) {
  const PictureContent& camera = *PicturesOf(channel->sensor);
  channel->frame_id = OpticalFrameOf(channel->machine, channel->sensor.name);
  AddTopic<CameraInfo>(kCameraInfoTopic, Delivery::kLarge, channel);
  if (camera.rgb) AddTopic<Image>(kColourTopic, Delivery::kLarge, channel);
  if (camera.depth) {
    AddTopic<Image>(kDepthTopic, Delivery::kLarge, channel);
    AddTopic<CameraInfo>(kDepthInfoTopic, Delivery::kLarge, channel);
  }
  for (const LabelChannel& label : kLabelChannels) {
    if (camera.labels[IndexOf(label)])
      AddTopic<Image>(LabelTopic(label), Delivery::kLarge, channel);
  }
}

void SamplePublisher::AddLidar(const ChannelInfo&, Channel* channel) {
  AddTopic<PointCloud2>(kPointsTopic, Delivery::kLarge, channel);
}

template <typename Make>
void SamplePublisher::Send(const Channel& channel, const std::string& topic, TimeNs at_ns,
                           const Make& make) {
  const auto writer = channel.topics.find(topic);
  if (writer == channel.topics.end() || !participant_->HasReaders(writer->second)) return;
  outgoing_.emplace(at_ns, Outgoing{writer->second, make()});
}

void SamplePublisher::Write(ChannelId id, Measurement measurement) {
  const Channel& channel = channels_.at(id);
  std::visit([&](const auto& measured) { Write(channel, measured); }, measurement);
}

void SamplePublisher::Write(const Channel& channel, const RowSample& row) {
  Send(channel, channel.row_topic, row.t_available_ns, [&] { return channel.row_message(row); });
}

void SamplePublisher::Write(const Channel& channel, const CameraFrame& frame) {
  const auto send = [&](const std::string& topic, const auto& make) {
    Send(channel, topic, frame.t_available_ns, make);
  };
  const auto info = [&] {
    return CameraInfoMessage({frame.t_ns, channel.frame_id},
                             LensOf(PicturesOf(channel.sensor)->intrinsics));
  };
  send(kColourTopic, [&] { return ColourMessage(frame, channel.frame_id); });
  send(kCameraInfoTopic, info);
  send(kDepthTopic, [&] { return DepthMessage(frame, channel.frame_id); });
  send(kDepthInfoTopic, info);
  for (const LabelChannel& label : kLabelChannels) {
    send(LabelTopic(label), [&] { return LabelMessage(label, frame, channel.frame_id); });
  }
}

void SamplePublisher::Write(const Channel& channel, const LidarScan& scan) {
  Send(channel, kPointsTopic, scan.t_available_ns,
       [&] { return PointCloudMessage(scan, channel.frame_id); });
}

bool SamplePublisher::NeedsFrame(ChannelId id, TimeNs, TimeNs) const {
  const auto& topics = channels_.at(id).topics;
  return std::any_of(topics.begin(), topics.end(),
                     [&](const auto& topic) { return participant_->HasReaders(topic.second); });
}

void SamplePublisher::MarkPresent(ChannelId, TimeNs) {}

}  // namespace tera::ros
