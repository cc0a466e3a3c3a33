#include "serve/sample_keeper.h"

#include <bit>
#include <string_view>
#include <utility>

#include "core/overloaded.h"
#include "core/types/label_channels.h"
#include "core/types/sample_rows.h"
#include "serve/geometry_messages.h"

namespace tera {
namespace {

static_assert(std::endian::native == std::endian::little, "messages hold little-endian numbers");

template <typename Sample, typename Message>
void PutTimes(const Sample& sample, Message* message) {
  message->set_time_ns(sample.t_ns);
  message->set_available_ns(sample.t_available_ns);
}

template <typename T>
void PutBytes(const std::vector<T>& values, std::string* bytes) {
  bytes->assign(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <typename T>
void Append(const T& value, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

void PutImu(const RowSample& row, v1::SensorSamples* samples) {
  const ImuSample sample = ImuSampleOf(row);
  v1::ImuSample& message = *samples->add_imu();
  PutTimes(sample, &message);
  Put(sample.w_WS_S_radps, message.mutable_angular_rate_s_radps());
  Put(sample.f_S_mps2, message.mutable_specific_force_s_mps2());
}

void PutGnss(const RowSample& row, v1::SensorSamples* samples) {
  const GnssSample sample = GnssSampleOf(row);
  v1::GnssSample& message = *samples->add_gnss();
  PutTimes(sample, &message);
  message.set_fix(static_cast<std::uint32_t>(sample.fix));
  message.set_lat_deg(sample.lat_deg);
  message.set_lon_deg(sample.lon_deg);
  message.set_height_m(sample.alt_m);
  Put(sample.enu_m, message.mutable_enu_m());
  Put(sample.variance_enu_m2, message.mutable_variance_enu_m2());
}

void PutEncoder(const RowSample& row, v1::SensorSamples* samples) {
  const EncoderSample sample = EncoderSampleOf(row);
  v1::EncoderSample& message = *samples->add_encoder();
  PutTimes(sample, &message);
  message.mutable_position()->Add(sample.q_rad.begin(), sample.q_rad.end());
  message.mutable_rate()->Add(sample.qd_radps.begin(), sample.qd_radps.end());
}

void PutRow(const RowSample& row, v1::SensorSamples* samples) {
  v1::RowSample& message = *samples->add_row();
  PutTimes(row, &message);
  message.mutable_value()->Add(row.values.begin(), row.values.end());
}

/// Types of row sensors that have their own message type. Others use RowSample.
using PutSample = void (*)(const RowSample&, v1::SensorSamples*);
constexpr std::pair<std::string_view, PutSample> kOwnMessages[] = {
    {kImuChannel, PutImu}, {kGnssChannel, PutGnss}, {kEncoderChannel, PutEncoder}};

PutSample PutOf(std::string_view type) {
  for (const auto& [kind, put] : kOwnMessages) {
    if (kind == type) return put;
  }
  return PutRow;
}

/// Appends an image. All images of a frame must have the same size.
template <typename T>
void PutPicture(const Image<T>& picture, std::string* bytes, v1::CameraFrame* message) {
  if (picture.empty()) return;
  message->set_width_px(picture.width_px);
  message->set_height_px(picture.height_px);
  PutBytes(picture.data, bytes);
}

void PutFrame(const CameraFrame& frame, v1::SensorSamples* samples) {
  v1::CameraFrame& message = *samples->add_camera();
  PutTimes(frame, &message);
  PutPicture(frame.rgb, message.mutable_rgb(), &message);
  PutPicture(frame.depth_m, message.mutable_depth_m(), &message);
  PutPicture(frame.semantic, message.mutable_semantic(), &message);
  PutPicture(frame.instance, message.mutable_instance(), &message);
  ForEachLabel(frame, [&](const LabelChannel& channel, const auto& picture) {
    const bool has_a_field =
        IndexOf(channel) == kSemanticChannel || IndexOf(channel) == kInstanceChannel;
    if (has_a_field || picture.empty()) return;
    PutPicture(picture, &(*message.mutable_labels())[std::string(channel.name)], &message);
  });
}

void PutScan(const LidarScan& scan, v1::SensorSamples* samples) {
  v1::LidarScan& message = *samples->add_lidar();
  PutTimes(scan, &message);
  message.set_points(static_cast<std::uint32_t>(scan.points.size()));
  for (const LidarPoint& point : scan.points) {
    for (const float coordinate_m : {point.x_m, point.y_m, point.z_m}) {
      Append(coordinate_m, message.mutable_xyz_s_m());
    }
    Append(point.intensity, message.mutable_intensity());
    Append(point.time_offset_ns, message.mutable_time_offset_ns());
    Append(point.ring, message.mutable_ring());
    Append(point.label, message.mutable_semantic());
    Append(point.instance, message.mutable_instance());
  }
}

}  // namespace

bool HasOwnMessage(std::string_view kind) { return PutOf(kind) != PutRow; }

void SampleKeeper::Keep(const std::vector<SensorPlan>& sensors, TimeNs end_ns) {
  plans_ = sensors;
  end_ns_ = end_ns;
  samples_.assign(sensors.size(), {});
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    samples_[k].set_machine(sensors[k].machine);
    samples_[k].set_sensor(sensors[k].sensor);
  }
  for (Channel& channel : channels_) channel.kept = PlanOf(channel.folder);
}

void SampleKeeper::Take(v1::Observation* observation) {
  for (v1::SensorSamples& samples : samples_) *observation->add_samples() = std::move(samples);
  Keep({}, end_ns_);
}

int SampleKeeper::PlanOf(const std::string& folder) const {
  for (std::size_t k = 0; k < plans_.size(); ++k) {
    if (plans_[k].machine + "/" + plans_[k].sensor == folder) return static_cast<int>(k);
  }
  return kNotKept;
}

ChannelId SampleKeeper::AddChannel(const ChannelInfo& info) {
  channels_.push_back({info.path, info.type, PlanOf(info.path)});
  return static_cast<ChannelId>(channels_.size() - 1);
}

bool SampleKeeper::NeedsFrame(ChannelId channel, TimeNs, TimeNs next_ns) const {
  const int kept = channels_[channel].kept;
  return kept != kNotKept && (!plans_[kept].latest_only || next_ns > end_ns_);
}

void SampleKeeper::Write(ChannelId id, Measurement measurement) {
  const Channel& channel = channels_[id];
  if (channel.kept == kNotKept) return;
  v1::SensorSamples* samples = &samples_[channel.kept];
  if (plans_[channel.kept].latest_only) {
    samples->clear_camera();
    samples->clear_lidar();
  }
  std::visit(Overloaded{[&](const RowSample& row) { PutOf(channel.type)(row, samples); },
                        [&](const CameraFrame& frame) { PutFrame(frame, samples); },
                        [&](const LidarScan& scan) { PutScan(scan, samples); }},
             measurement);
}

}  // namespace tera
