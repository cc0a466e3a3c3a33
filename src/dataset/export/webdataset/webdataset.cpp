#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/types/label_channels.h"
#include "dataset/export/export_job.h"
#include "dataset/export/picture/labelled_frame.h"
#include "dataset/export/record_views.h"
#include "dataset/export/sensor_names.h"
#include "dataset/export/sensor_track.h"
#include "dataset/export/webdataset/dataset_card.h"
#include "dataset/export/webdataset/npy.h"
#include "dataset/export/webdataset/shards.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// The list in a file of boxes.
OrderedJson BoxesIn(const fs::path& file) {
  try {
    return OrderedJson::parse(ReadWholeFile(file)).at("boxes");
  } catch (const nlohmann::json::exception& e) {
    throw InputError(
        file.string(),
        {FaultKind::kMalformed, fmt::format("not a file of boxes: {}; write it again", e.what())});
  }
}

/// One camera or lidar.
class SensorSamples {
 public:
  SensorSamples(ExportJob* job, const std::string& sensor, bool is_lidar)
      : job_(*job),
        sensor_(sensor),
        is_lidar_(is_lidar),
        shards_(job->folder, sensor, job->options.shard_bytes) {
    if (job_.recording.Has(SensorPoseFile(sensor))) poses_ = SensorTrack(job, sensor).X_WS;
    const fs::path sheet = job_.recording.directory() / sensor / "sensor.yaml";
    WriteWholeFile(job_.folder / (FlatName(sensor) + ".sensor.yaml"), ReadWholeFile(sheet));
  }

  void Add(TimeNs t_ns) {
    if (shards_.Has(t_ns)) return;
    std::vector<SamplePart> parts = is_lidar_ ? ScanParts(t_ns) : PictureParts(t_ns);
    parts.push_back({"json", About(t_ns).dump() + "\n"});
    shards_.Add(t_ns, parts);
  }
  bool HasArchive() const { return !shards_.archives().archives.empty(); }
  const SensorArchives& Commit() {
    shards_.Commit();
    return shards_.archives();
  }

 private:
  std::vector<SamplePart> ScanParts(TimeNs t_ns) const {
    return {{"points.npy", NpyOf(job_.recording.LoadScan(sensor_, t_ns).points)}};
  }

  std::vector<SamplePart> PictureParts(TimeNs t_ns) const {
    std::vector<SamplePart> parts;
    const auto take = [&](std::string_view kind) {
      const fs::path file = FrameFile(job_.recording, sensor_, kind, t_ns);
      if (IsThere(file)) parts.push_back({std::string(kind) + ".png", ReadWholePng(file)});
    };
    take("rgb");
    take("depth");
    for (const LabelChannel& channel : kLabelChannels) take(channel.name);
    if (parts.empty()) {
      throw InputError((job_.recording.directory() / sensor_).string(),
                       {FaultKind::kMissing,
                        fmt::format("there is no image of t_ns {}; data.csv names one", t_ns)});
    }
    return parts;
  }

  OrderedJson About(TimeNs t_ns) const {
    OrderedJson about = {{"sensor", sensor_}, {"t_ns", t_ns}};
    if (job_.options.start_utc_ns) about["utc_ns"] = job_.Stamp(t_ns);
    if (poses_) {
      const Pose X_WS = poses_->At(t_ns);
      const Vec3& p = X_WS.translation();
      const Quat q = UnitQuaternion(X_WS);
      about["X_WS"] = {{"p_WS_m", {p.x(), p.y(), p.z()}},
                       {"q_WS_wxyz", {q.w(), q.x(), q.y(), q.z()}}};
    }
    const fs::path boxes = FrameFile(job_.recording, sensor_, "boxes", t_ns);
    if (IsThere(boxes)) about["boxes"] = BoxesIn(boxes);
    return about;
  }

  const ExportJob& job_;
  std::string sensor_;
  bool is_lidar_;
  Shards shards_;
  std::optional<PoseTrack> poses_;
};

}  // namespace

/// Writes for each camera and lidar MACHINE_SENSOR-000000.tar and on, the list MACHINE_SENSOR.json,
/// and its sensor.yaml. A sample is an exposure (rgb.png, depth.png, semantic.png, instance.png,
/// normal.png, those that it has) or a scan (points.npy), with json: time, pose, boxes. With --card
/// also README.md and croissant.json.
void ExportWebdataset(ExportJob* job) {
  std::vector<std::string> sensors = job->recording.SensorsOf(ChannelForm::kPictures);
  const std::size_t cameras = sensors.size();
  for (const std::string& lidar : job->recording.SensorsOf(ChannelForm::kScans)) {
    sensors.push_back(lidar);
  }
  RequireAny(sensors, *job, "camera or lidar");
  RequireFlatNamesApart(sensors);
  std::optional<CardFacts> facts;
  if (!job->options.card.empty()) facts = ReadCardFacts(job->options.card);
  std::vector<std::unique_ptr<SensorSamples>> samples;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    samples.push_back(std::make_unique<SensorSamples>(job, sensors[s], s >= cameras));
  }
  RecordStream stream(job->recording, sensors);
  for (Record record; job->Next(&stream, &record);) {
    SensorSamples& of_sensor = *samples[record.channel];
    of_sensor.Add(record.t_ns);
    job->frames_written = job->frames_written || of_sensor.HasArchive();
  }
  std::vector<SensorArchives> archives;
  for (const auto& sensor : samples) archives.push_back(sensor->Commit());
  if (!facts) return;
  WriteWholeFile(job->folder / "croissant.json", CroissantJson(*job, *facts, archives));
  WriteWholeFile(job->folder / "README.md", CardText(*job, *facts, archives));
}

}  // namespace tera
