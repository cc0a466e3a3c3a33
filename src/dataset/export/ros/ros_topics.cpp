#include "dataset/export/ros/ros_topics.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/types/label_channels.h"
#include "core/types/sample_rows.h"
#include "dataset/export/picture/labelled_frame.h"
#include "dataset/export/record_views.h"
#include "dataset/export/ros/joint_table.h"
#include "dataset/export/ros/static_transforms.h"
#include "dataset/format/events_table.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/ros/from_samples.h"
#include "dataset/ros/names.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr SampleClock kClock = {100.0, 0};  ///< rate of /clock

}  // namespace

RosTopics::RosTopics(ExportJob* job, BagWriter* bag) : job_(job), bag_(bag) {
  clock_ = AddTopic<ros::Clock>("/clock", kLatest);
  transforms_ = AddTopic<ros::TfMessage>("/tf", kManyTransforms);
  static_transforms_ = AddTopic<ros::TfMessage>("/tf_static", kLatched);
  if (job->options.read_ground) {
    for (GroundSnapshot& snapshot : GroundSnapshotsOf(job->recording)) {
      snapshots_.push_back(std::move(snapshot));
    }
  }
  if (!snapshots_.empty()) ground_ = AddTopic<ros::GridMap>("/truth/terrain", kLatched);
  AddChannels();
}

void RosTopics::AddTake(const std::string& path, Take take) {
  auto [own, is_new] = takes_.try_emplace(path);
  own->second.push_back(std::move(take));
  if (is_new) channels_.push_back({path, 0});
}

std::string RosTopics::RootFrameOf(const std::string& machine) const {
  const JointTree* const tree = job_->JointTreeOf(machine);
  return ros::FrameOf(machine, tree ? tree->root : "base_link");
}

void RosTopics::AddChannels() {
  const Recording& recording = job_->recording;
  for (const ChannelDescription& channel : recording.channels()) {
    if (channel.type == kPoseChannel) {
      AddPose(channel.path);
    } else if (channel.type == kTableChannel) {
      AddTable(channel.path);
    } else if (channel.type != kEventsChannel) {
      AddSensor(channel.path);
    }
  }
}

void RosTopics::AddSensor(const std::string& path) {
  const std::vector<std::string> cameras = job_->recording.SensorsOf(ChannelForm::kPictures);
  const std::vector<std::string> lidars = job_->recording.SensorsOf(ChannelForm::kScans);
  const auto is_among = [&](const std::vector<std::string>& paths) {
    return std::find(paths.begin(), paths.end(), path) != paths.end();
  };
  if (is_among(cameras)) return AddCamera(path);
  if (is_among(lidars)) return AddLidar(path);
  AddRows(path);
}

void RosTopics::AddRows(const std::string& path) {
  const SensorSheet sheet = ReadSensorSheet(job_->recording.directory() / path);
  const std::string_view type = job_->recording.TypeOf(path);
  const std::string machine = MachineOf(path), name = fs::path(path).filename();
  const std::string frame_id = ros::FrameOf(machine, name);
  const std::string topic = ros::TopicOf(machine, ros::SensorTopicOf(name, type));
  if (type == kImuChannel) {
    const TopicId id = AddTopic<ros::Imu>(topic, kSensorData);
    const double period_s = sheet.rate_hz > 0 ? 1 / sheet.rate_hz : 1;
    const ImuNoise noise = sheet.imu_noise.value_or(ImuNoise{});
    AddTake(path, [=, this](const Record& record) {
      ImuSample sample = ImuOf(*stream_, record);
      sample.t_ns = job_->Stamp(record.t_ns);
      Write(id, job_->Stamp(record.t_available_ns),
            ros::ImuMessage(sample, frame_id, noise, period_s));
    });
  } else if (type == kGnssChannel) {
    const TopicId id = AddTopic<ros::NavSatFix>(topic + "/" + ros::kFixTopic, kSensorData);
    AddTake(path, [=, this](const Record& record) {
      GnssSample sample = GnssOf(*stream_, record);
      sample.t_ns = job_->Stamp(record.t_ns);
      Write(id, job_->Stamp(record.t_available_ns), ros::NavSatFixMessage(sample, frame_id));
    });
  } else {
    AddTake(path, JointStateTake(topic, frame_id, kSensorData));
  }
  channels_.back().delay_ns = sheet.latency_ns;
}

RosTopics::Take RosTopics::JointStateTake(const std::string& topic, const std::string& frame_id,
                                          const TopicQuality& quality) {
  const TopicId id = AddTopic<ros::JointState>(topic, quality);
  return [=, this](const Record& record) {
    RowSample row = RowOf(record);
    row.t_ns = job_->Stamp(record.t_ns);
    Write(id, job_->Stamp(record.t_available_ns),
          ros::JointStateOfRow(row, frame_id, stream_->columns(record.channel)));
  };
}

void RosTopics::AddCamera(const std::string& path) {
  const SensorSheet sheet = ReadSensorSheet(job_->recording.directory() / path);
  const std::string machine = MachineOf(path), name = fs::path(path).filename();
  const std::string frame_id = ros::OpticalFrameOf(machine, name);
  const std::string topic = ros::TopicOf(machine, name) + "/";
  std::error_code ignored;
  const auto has = [&](std::string_view kind) {
    const fs::path folder = job_->recording.directory() / path / kind;
    return fs::is_directory(folder, ignored) && !fs::is_empty(folder, ignored);
  };
  const bool compressed = job_->options.images == BagImages::kCompressed;
  std::vector<PictureTopic> pictures;
  std::vector<TopicId> infos;
  const auto add = [&](const std::string& kind, const std::string& below,
                       const LabelChannel* label) {
    if (!has(kind)) return;
    const std::string own = topic + below + (compressed ? "/compressed" : "");
    pictures.push_back({kind,
                        compressed ? AddTopic<ros::CompressedImage>(own, kLarge)
                                   : AddTopic<ros::Image>(own, kLarge),
                        label});
  };
  add("rgb", ros::kColourTopic, nullptr);
  add("depth", ros::kDepthTopic, nullptr);
  for (const LabelChannel& label : kLabelChannels) {
    add(std::string(label.name), ros::LabelTopic(label), &label);
  }
  if (sheet.lens) infos.push_back(AddTopic<ros::CameraInfo>(topic + ros::kCameraInfoTopic, kLarge));
  if (sheet.lens && has("depth")) {
    infos.push_back(AddTopic<ros::CameraInfo>(topic + ros::kDepthInfoTopic, kLarge));
  }
  AddTake(path, [=, this](const Record& record) {
    std::vector<PictureTopic> there;
    for (const PictureTopic& own : pictures) {
      const fs::path file = FrameFile(job_->recording, path, own.kind, record.t_ns);
      if (fs::exists(file)) {
        there.push_back(own);
      } else {
        job_->absent.Add(file);
      }
    }
    messages_->Give([=, this] {
      return compressed ? CompressedPictures(path, record, there, frame_id)
                        : RawPictures(path, record, there, frame_id);
    });
    const TimeNs at_ns = job_->Stamp(record.t_available_ns), stamp_ns = job_->Stamp(record.t_ns);
    for (const TopicId info : infos) {
      Write(info, at_ns, ros::CameraInfoMessage({stamp_ns, frame_id}, *sheet.lens));
    }
  });
  channels_.back().delay_ns = sheet.latency_ns;
}

std::vector<RosTopics::WireMessage> RosTopics::CompressedPictures(
    const std::string& path, const Record& record, const std::vector<PictureTopic>& pictures,
    const std::string& frame_id) const {
  std::vector<WireMessage> messages;
  for (const PictureTopic& own : pictures) {
    const fs::path file = FrameFile(job_->recording, path, own.kind, record.t_ns);
    messages.push_back(Wire(
        own.topic, job_->Stamp(record.t_available_ns),
        ros::CompressedImage{{job_->Stamp(record.t_ns), frame_id}, "png", ReadWholePng(file)}));
  }
  return messages;
}

std::vector<RosTopics::WireMessage> RosTopics::RawPictures(
    const std::string& path, const Record& record, const std::vector<PictureTopic>& pictures,
    const std::string& frame_id) const {
  const TimeNs at_ns = job_->Stamp(record.t_available_ns);
  CameraFrame frame = job_->recording.LoadFrame(path, record.t_ns);
  frame.t_ns = job_->Stamp(record.t_ns);
  std::vector<WireMessage> messages;
  for (const PictureTopic& own : pictures) {
    if (own.label != nullptr) {
      messages.push_back(Wire(own.topic, at_ns, ros::LabelMessage(*own.label, frame, frame_id)));
    } else {
      messages.push_back(Wire(own.topic, at_ns,
                              own.kind == "rgb" ? ros::ColourMessage(frame, frame_id)
                                                : ros::DepthMessage(frame, frame_id)));
    }
  }
  return messages;
}

void RosTopics::AddLidar(const std::string& path) {
  const SensorSheet sheet = ReadSensorSheet(job_->recording.directory() / path);
  const std::string machine = MachineOf(path), name = fs::path(path).filename();
  const std::string frame_id = ros::FrameOf(machine, name);
  const TopicId id =
      AddTopic<ros::PointCloud2>(ros::TopicOf(machine, name) + "/" + ros::kPointsTopic, kLarge);
  AddTake(path, [=, this](const Record& record) {
    const TimeNs at_ns = job_->Stamp(record.t_available_ns);
    messages_->Give([=, this, t_ns = record.t_ns]() -> std::vector<WireMessage> {
      LidarScan scan = job_->recording.LoadScan(path, t_ns);
      scan.t_ns = job_->Stamp(t_ns);
      return {Wire(id, at_ns, ros::PointCloudMessage(scan, frame_id))};
    });
  });
  // A scan is available after its last ray.
  const TimeNs turn_ns = sheet.rate_hz > 0 ? SampleClock{sheet.rate_hz, 0}.Period() : 0;
  channels_.back().delay_ns = sheet.latency_ns + turn_ns;
}

void RosTopics::AddPose(const std::string& path) {
  const std::string body = NameOfBody(path);
  const bool of_machine = fs::path(path).filename() == "pose.csv" && IsMachine(body);
  if (!of_machine) {
    AddTake(path, PoseTake("/truth/" + body));
    return;
  }
  const std::string frame_id = RootFrameOf(body);
  const JointTree* const tree = job_->JointTreeOf(body);
  if (tree == nullptr || !tree->fixed_base) {
    AddTake(path, [=, this](const Record& record) {
      const ros::Header header = {job_->Stamp(record.t_ns), ros::kWorldFrame};
      Write(transforms_, job_->Stamp(record.t_available_ns),
            ros::TfMessage{{{header, frame_id, PoseOf(*stream_, record).X_WB}}});
    });
  }
  if (ColumnsOf(path) != PoseColumns(/*with_velocity=*/true)) {
    AddTake(path, PoseTake(ros::TopicOf(body, "pose")));
    return;
  }
  const TopicId id = AddTopic<ros::Odometry>(ros::TopicOf(body, "odom"), kState);
  AddTake(path, [=, this](const Record& record) {
    const TruthPose pose = PoseOf(*stream_, record);
    Write(id, job_->Stamp(record.t_available_ns),
          ros::Odometry{{job_->Stamp(record.t_ns), ros::kWorldFrame},
                        frame_id,
                        pose.X_WB,
                        pose.X_WB.linear().transpose() * pose.v_WB_mps,
                        pose.w_WB_B_radps});
  });
}

RosTopics::Take RosTopics::PoseTake(const std::string& topic) {
  const TopicId id = AddTopic<ros::PoseStamped>(topic, kState);
  return [=, this](const Record& record) {
    Write(id, job_->Stamp(record.t_available_ns),
          ros::PoseStamped{{job_->Stamp(record.t_ns), ros::kWorldFrame},
                           PoseOf(*stream_, record).X_WB});
  };
}

bool RosTopics::IsMachine(const std::string& body) const {
  const std::vector<ChannelDescription>& channels = job_->recording.channels();
  return body.find('/') == std::string::npos &&
         (job_->JointTreeOf(body) != nullptr ||
          std::any_of(channels.begin(), channels.end(), [&](const ChannelDescription& channel) {
            return channel.path.starts_with(body + "/");
          }));
}

void RosTopics::AddTable(const std::string& path) {
  const std::string machine = MachineOf(path), file = fs::path(path).filename();
  const std::string frame_id = RootFrameOf(machine);
  if (path == machine + "/commands.csv") {
    AddTake(path, JointStateTake(ros::TopicOf(machine, "levers"), frame_id, kSensorData));
    AddLevers(path);
    return;
  }
  const std::string topic = "/" + WithoutEnding(path, fs::path(path).extension().string());
  AddTake(path, JointStateTake(topic, frame_id, kState));
  if (path == "truth/" + machine + "/joints.csv") AddJoints(path);
  if (path == "truth/" + machine + "/hydraulics.csv") AddCylinders(path);
}

std::vector<std::string> RosTopics::ColumnsOf(const std::string& path) const {
  return RowScan(job_->recording.directory() / path).columns();
}

void RosTopics::WriteClockUntil(TimeNs t_ns) {
  for (; kClock.Due(next_tick_) <= t_ns; ++next_tick_) {
    WriteGroundUntil(kClock.Due(next_tick_));
    const TimeNs tick_ns = job_->Stamp(kClock.Due(next_tick_));
    Write(clock_, tick_ns, ros::Clock{tick_ns});
  }
  WriteGroundUntil(t_ns);
}

void RosTopics::WriteGroundUntil(TimeNs t_ns) {
  for (; !snapshots_.empty() && snapshots_.front().t_ns <= t_ns; snapshots_.pop_front()) {
    const TimeNs stamp_ns = job_->Stamp(snapshots_.front().t_ns);
    Write(ground_, stamp_ns, GridMapOf(snapshots_.front(), stamp_ns, job_->options.read_ground));
  }
}

void RosTopics::Put(const std::vector<WireMessage>& messages) {
  for (const WireMessage& message : messages) {
    bag_->Write(message.topic, message.t_ns, message.bytes);
    ++job_->messages;
    if (told_) told_(message.topic, message.t_ns);
  }
}

void RosTopics::WriteAll() {
  stream_ = std::make_unique<RecordStream>(job_->recording, channels_);
  messages_ = std::make_unique<InOrder<std::vector<WireMessage>>>(
      job_->options.threads, [this](const std::vector<WireMessage>& messages) { Put(messages); });
  Record record;
  bool more = job_->Next(stream_.get(), &record);
  // Static transforms come first. A sensor clock may stamp records with negative times, which come
  // after them too.
  const TimeNs first_ns = more ? std::min<TimeNs>(0, record.t_available_ns) : 0;
  // If times count from an epoch, the clock starts at the first record.
  if (more) next_tick_ = std::max<std::int64_t>(0, record.t_available_ns / kClock.Period());
  Write(static_transforms_, job_->Stamp(first_ns), ros::TfMessage{StaticTransforms(job_)});
  for (; more; more = job_->Next(stream_.get(), &record)) {
    WriteClockUntil(record.t_available_ns);
    for (const Take& take : takes_.at(channels_[record.channel].path)) take(record);
  }
  WriteGroundUntil(std::numeric_limits<TimeNs>::max());
  messages_->Finish();
}

}  // namespace tera
