#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/types/label_channels.h"
#include "dataset/export/export_job.h"
#include "dataset/export/picture/labelled_frame.h"
#include "dataset/export/record_views.h"
#include "dataset/export/sensor_names.h"
#include "dataset/export/sensor_track.h"
#include "dataset/export/webdataset/dataset_card.h"
#include "dataset/export/webdataset/merged_archives.h"
#include "dataset/export/webdataset/npy.h"
#include "dataset/export/webdataset/shards.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// The list of objects in a boxes file.
OrderedJson BoxesIn(const fs::path& file) {
  try {
    return OrderedJson::parse(ReadWholeFile(file)).at("boxes");
  } catch (const nlohmann::json::exception& e) {
    throw InputError(
        file.string(),
        {FaultKind::kMalformed, fmt::format("not a file of boxes: {}; write it again", e.what())});
  }
}

/// Samples of one camera or lidar.
class SensorSamples {
 public:
  /// `episode` as in Shards::Add.
  SensorSamples(ExportJob* job, const std::string& sensor, bool is_lidar, Shards* shards,
                std::string episode = "")
      : job_(*job),
        sensor_(sensor),
        is_lidar_(is_lidar),
        shards_(*shards),
        episode_(std::move(episode)) {
    if (job_.recording.Has(SensorPoseFile(sensor))) poses_ = SensorTrack(job, sensor).X_WS;
    const fs::path sheet = job_.recording.directory() / sensor / "sensor.yaml";
    sheet_ = ReadWholeFile(sheet);
    if (!episode_.empty()) return;
    WriteWholeFile(job_.folder / (shards_.archives().name + ".sensor.yaml"), sheet_);
  }

  void Add(TimeNs t_ns) {
    if (shards_.Has(t_ns)) return;
    std::vector<SamplePart> parts = is_lidar_ ? ScanParts(t_ns) : PictureParts(t_ns);
    parts.push_back({"json", About(t_ns).dump() + "\n"});
    // Episodes may have different calibrations, so each sample includes one.
    if (!episode_.empty()) parts.push_back({"sensor.yaml", sheet_});
    shards_.Add(t_ns, parts, episode_);
  }
  bool HasArchive() const { return !shards_.archives().archives.empty(); }

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
      throw InputError(
          (job_.recording.directory() / sensor_).string(),
          {FaultKind::kMissing,
           fmt::format("the image of t_ns {} is missing, but data.csv lists it", t_ns)});
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
  Shards& shards_;
  std::string episode_, sheet_;
  std::optional<PoseTrack> poses_;
};

}  // namespace

/// Writes the archives MACHINE_SENSOR-000000.tar onwards, the list MACHINE_SENSOR.json and
/// sensor.yaml for each camera and lidar. A sample of a camera is an exposure with the images it
/// has: rgb.png, depth.png, semantic.png, instance.png, normal.png. A sample of a lidar is a scan,
/// points.npy. Each sample has a json file with time, pose and boxes. With --card, README.md and
/// croissant.json are written too.
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
  std::vector<std::unique_ptr<Shards>> shards;
  std::vector<std::unique_ptr<SensorSamples>> samples;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    shards.push_back(std::make_unique<Shards>(job->folder, sensors[s], job->options.shard_bytes));
    samples.push_back(
        std::make_unique<SensorSamples>(job, sensors[s], s >= cameras, shards.back().get()));
  }
  RecordStream stream(job->recording, sensors);
  for (Record record; job->Next(&stream, &record);) {
    SensorSamples& of_sensor = *samples[record.channel];
    of_sensor.Add(record.t_ns);
    job->frames_written = job->frames_written || of_sensor.HasArchive();
  }
  std::vector<SensorArchives> archives;
  for (const auto& sensor : shards) {
    sensor->Commit();
    archives.push_back(sensor->archives());
  }
  if (!facts) return;
  const DatasetInfo& info = job->recording.info();
  WriteWholeFile(job->folder / "croissant.json",
                 CroissantJson(job->folder, info, *facts, archives));
  WriteWholeFile(job->folder / "README.md", CardText(info, *facts, archives));
}

std::string WriteMergedArchives(const std::vector<MergedEpisode>& episodes, const fs::path& folder,
                                const MergedArchivesOptions& options) {
  const std::optional<CardFacts> facts =
      options.card.empty() ? std::nullopt : std::optional(ReadCardFacts(options.card));
  const ExportOptions of_export{.format = ExportFormat::kWebdataset};
  std::map<std::string, Shards> shards;  // by split and sensor
  std::vector<std::string> names;        // the keys of shards
  for (const MergedEpisode& episode : episodes) {
    const Recording recording(episode.dataset);
    ExportJob job{recording, folder, folder.string(), of_export};
    std::vector<std::string> sensors;
    std::vector<std::unique_ptr<SensorSamples>> samples;
    for (const ChannelForm form : {ChannelForm::kPictures, ChannelForm::kScans}) {
      for (const std::string& sensor : recording.SensorsOf(form)) {
        const std::vector<std::string>& chosen = options.sensors;
        if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), sensor) == chosen.end()) {
          continue;
        }
        const std::string name = episode.part.empty() ? sensor : episode.part + "-" + sensor;
        const auto [of_sensor, is_new] =
            shards.try_emplace(name, folder, name, options.shard_bytes);
        if (is_new) names.push_back(name);
        RequireFlatNamesApart(names);
        sensors.push_back(sensor);
        samples.push_back(std::make_unique<SensorSamples>(&job, sensor, form == ChannelForm::kScans,
                                                          &of_sensor->second, episode.name + "_"));
      }
    }
    RequireAny(sensors, job, "camera or lidar of those that are merged");
    RecordStream stream(recording, sensors);
    for (Record record; job.Next(&stream, &record);) samples[record.channel]->Add(record.t_ns);
  }
  std::vector<SensorArchives> archives;
  for (auto& [_, of_sensor] : shards) {
    of_sensor.Commit();
    archives.push_back(of_sensor.archives());
  }
  if (!facts) return "";
  WriteWholeFile(folder / "croissant.json", CroissantJson(folder, options.about, *facts, archives));
  return CardText(options.about, *facts, archives);
}

}  // namespace tera
