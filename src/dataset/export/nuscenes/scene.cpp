#include "dataset/export/nuscenes/scene.h"

#include <fmt/format.h>

#include <cctype>
#include <limits>
#include <optional>
#include <utility>

#include "dataset/export/stamp_text.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

/// A larger motion relative to the machine counts as a new mounting pose.
constexpr double kSameMount_m = 1e-4, kSameMount_rad = 1e-5;
constexpr TimeNs kNoScan_ns = std::numeric_limits<TimeNs>::min();

/// Microseconds since 1970.
std::int64_t Stamp_us(const ExportJob& job, TimeNs t_ns) {
  constexpr TimeNs kNsPerMicrosecond = 1000;
  return job.Stamp(t_ns, kDefaultStart_ns) / kNsPerMicrosecond;
}

std::string DateOf(const ExportJob& job) {
  const CivilTime t = CivilTimeOf(job.Stamp(0, kDefaultStart_ns));
  return fmt::format("{:04}-{:02}-{:02}", t.year, t.month, t.day);
}

/// Replaces characters other than letters, digits, '-' and '_', for use in file names.
std::string PlainName(std::string text) {
  for (char& c : text) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  }
  return text;
}

std::set<std::uint16_t> InstancesOf(const std::string& machine, const DatasetInfo& info) {
  std::set<std::uint16_t> own;
  for (const DatasetInfo::Instance& instance : info.instances) {
    const bool is_own = instance.name == machine || instance.name.starts_with(machine + "/");
    if (is_own) own.insert(instance.id);
  }
  return own;
}

OrderedJson IntrinsicJson(const std::optional<CameraLens>& lens) {
  if (!lens) return OrderedJson::array();
  return {{lens->fx_px, 0.0, lens->cx_px}, {0.0, lens->fy_px, lens->cy_px}, {0.0, 0.0, 1.0}};
}

}  // namespace

NuScenesScene::NuScenesScene(ExportJob* job, const NuScenesRig& rig, std::size_t scene,
                             std::size_t first_sensor, const NuTokens& tokens, NuTables* tables)
    : job_(job),
      rig_(rig),
      scene_(scene),
      first_sensor_(first_sensor),
      tokens_(tokens),
      tables_(tables),
      log_name_(PlainName(job->recording.info().scenario_name + "-" + rig.machine)),
      period_ns_(FromSeconds(1 / job->options.key_frames_hz)),
      samples_ns_(SampleTimes(rig.sensors.front().t_ns, period_ns_)),
      own_(InstancesOf(rig.machine, job->recording.info())) {
  for (const NuScenesSensor& sensor : rig.sensors) {
    files_.emplace_back(job->recording, sensor);
    frames_.push_back(FramesOfSamples(sensor.t_ns, samples_ns_, period_ns_));
  }
}

void NuScenesScene::Write() {
  WriteLogAndScene();
  WriteSensors();
  WriteSamples();
  WriteAnnotations();
  WriteData();
}

std::string NuScenesScene::SampleToken(std::int64_t sample) const {
  return tokens_.IfAny(NuTable::kSample, scene_, sample, sample_count());
}

void NuScenesScene::WriteLogAndScene() {
  const DatasetInfo& info = job_->recording.info();
  tables_->Add(
      NuTable::kLog,
      {{"token", tokens_.Of(NuTable::kLog, scene_, 0)},
       {"logfile", log_name_},
       {"vehicle", rig_.machine},
       {"date_captured", DateOf(*job_)},
       {"location", fmt::format("{:.6f} {:.6f}", info.origin_lat_deg, info.origin_lon_deg)}});
  tables_->Add(NuTable::kScene, {{"token", tokens_.Of(NuTable::kScene, scene_, 0)},
                                 {"log_token", tokens_.Of(NuTable::kLog, scene_, 0)},
                                 {"nbr_samples", sample_count()},
                                 {"first_sample_token", SampleToken(0)},
                                 {"last_sample_token", SampleToken(sample_count() - 1)},
                                 {"name", fmt::format("scene-{:04}", scene_ + 1)},
                                 {"description", info.scenario_name + ", " + rig_.machine}});
}

void NuScenesScene::WriteSensors() {
  for (std::size_t s = 0; s < rig_.sensors.size(); ++s) {
    tables_->Add(NuTable::kSensor,
                 {{"token", tokens_.Of(NuTable::kSensor, first_sensor_ + s, 0)},
                  {"channel", rig_.sensors[s].channel},
                  {"modality", rig_.sensors[s].is_camera() ? "camera" : "lidar"}});
  }
}

void NuScenesScene::WriteSamples() {
  for (std::int64_t s = 0; s < sample_count(); ++s) {
    const TimeNs t_ns = samples_ns_[static_cast<std::size_t>(s)];
    tables_->Add(NuTable::kSample, {{"token", SampleToken(s)},
                                    {"timestamp", Stamp_us(*job_, t_ns)},
                                    {"prev", SampleToken(s - 1)},
                                    {"next", SampleToken(s + 1)},
                                    {"scene_token", tokens_.Of(NuTable::kScene, scene_, 0)}});
  }
}

void NuScenesScene::WriteAnnotations() {
  AnnotationWriter annotations(tokens_, scene_, tables_);
  // per sample and sensor: the time of the scan, or kNoScan_ns
  std::vector<std::vector<TimeNs>> scans_ns(samples_ns_.size());
  for (std::size_t s = 0; s < rig_.sensors.size(); ++s) {
    if (rig_.sensors[s].is_camera()) continue;
    for (std::size_t f = 0; f < frames_[s].size(); ++f) {
      if (!frames_[s][f].is_key) continue;
      scans_ns[frames_[s][f].sample].resize(rig_.sensors.size(), kNoScan_ns);
      scans_ns[frames_[s][f].sample][s] = rig_.sensors[s].t_ns[f];
    }
  }
  std::int64_t next = 0;
  InOrder<std::vector<AnnotatedObject>> samples(
      job_->options.threads, [&](const auto& objects) { annotations.Add(next++, objects); });
  for (std::size_t sample = 0; sample < samples_ns_.size(); ++sample) {
    samples.Give([&, sample] { return ObjectsOf(sample, scans_ns[sample]); });
  }
  samples.Finish();
  annotations.Finish();
}

std::vector<AnnotatedObject> NuScenesScene::ObjectsOf(std::size_t sample,
                                                      const std::vector<TimeNs>& scans_ns) const {
  std::vector<AnnotatedObject> objects =
      ObjectsAt(job_->recording, rig_, samples_ns_[sample], period_ns_);
  for (std::size_t s = 0; s < scans_ns.size() && !objects.empty(); ++s) {
    if (scans_ns[s] == kNoScan_ns) continue;
    CountPoints(files_[s].InWorld(files_[s].Points(scans_ns[s]), scans_ns[s]), &objects);
  }
  return objects;
}

void NuScenesScene::WriteData() {
  std::vector<std::string> paths;
  for (const NuScenesSensor& sensor : rig_.sensors) {
    paths.push_back(sensor.path);
    MakeFolder(job_->folder / "samples" / sensor.channel);
    MakeFolder(job_->folder / "sweeps" / sensor.channel);
  }
  std::vector<std::size_t> next(paths.size(), 0);
  WrittenFrames frames(job_->options.threads, [&](const WrittenFrame& frame) {
    job_->Written(paths[frame.sensor], frame.t_ns, frame.files);
  });
  RecordStream stream(job_->recording, paths);
  for (Record record; job_->Next(&stream, &record);) {
    WriteFrame(record.channel, next[record.channel]++, &frames);
  }
  frames.Finish();
}

void NuScenesScene::WriteFrame(std::size_t s, std::size_t f, WrittenFrames* frames) {
  const NuScenesSensor& sensor = rig_.sensors[s];
  const FrameOfSample& of = frames_[s][f];
  const TimeNs t_ns = sensor.t_ns[f];
  const std::size_t list = first_sensor_ + s;
  const auto entry = static_cast<std::int64_t>(f);
  const auto count = static_cast<std::int64_t>(sensor.t_ns.size());
  const std::string token = tokens_.Of(NuTable::kSampleData, list, entry);
  const std::string pose_token = tokens_.Of(NuTable::kEgoPose, list, entry);
  const std::string file = fmt::format(
      "{}/{}/{}__{}__{}.{}", of.is_key ? "samples" : "sweeps", sensor.channel, log_name_,
      sensor.channel, Stamp_us(*job_, t_ns), sensor.is_camera() ? "png" : "pcd.bin");
  GiveFiles(s, t_ns, file, of.is_key ? token : "", frames);
  const Pose X_WB = rig_.X_WB.At(t_ns);
  tables_->Add(NuTable::kEgoPose, {{"token", pose_token},
                                   {"timestamp", Stamp_us(*job_, t_ns)},
                                   {"rotation", RotationJson(X_WB)},
                                   {"translation", TranslationJson(X_WB)}});
  tables_->Add(NuTable::kSampleData,
               {{"token", token},
                {"sample_token", SampleToken(static_cast<std::int64_t>(of.sample))},
                {"ego_pose_token", pose_token},
                {"calibrated_sensor_token", MountToken(s, t_ns)},
                {"timestamp", Stamp_us(*job_, t_ns)},
                {"fileformat", sensor.is_camera() ? "png" : "pcd"},
                {"is_key_frame", of.is_key},
                {"height", sensor.is_camera() ? sensor.lens->height_px : 0},
                {"width", sensor.is_camera() ? sensor.lens->width_px : 0},
                {"filename", file},
                {"prev", tokens_.IfAny(NuTable::kSampleData, list, entry - 1, count)},
                {"next", tokens_.IfAny(NuTable::kSampleData, list, entry + 1, count)}});
}

void NuScenesScene::GiveFiles(std::size_t s, TimeNs t_ns, const std::string& file,
                              const std::string& key_token, WrittenFrames* frames) {
  const NuScenesSensor& sensor = rig_.sensors[s];
  WrittenFrame frame = {s, t_ns, {job_->folder / file}};
  if (!sensor.is_camera() && !key_token.empty()) {
    const std::string labels =
        fmt::format("lidarseg/{}/{}_lidarseg.bin", kNuScenesVersion, key_token);
    tables_->Add(NuTable::kLidarseg,
                 {{"token", key_token}, {"sample_data_token", key_token}, {"filename", labels}});
    frame.files.push_back(job_->folder / labels);
  }
  if (job_->IsWritten(sensor.path, t_ns)) return;
  frames->Give([this, frame = std::move(frame)] { return WriteFiles(frame); });
}

NuScenesScene::WrittenFrame NuScenesScene::WriteFiles(WrittenFrame frame) const {
  const SensorFrames& frames = files_[frame.sensor];
  if (rig_.sensors[frame.sensor].is_camera()) {
    WriteWholeFile(frame.files.front(), frames.PictureBytes(frame.t_ns));
    return frame;
  }
  const std::vector<LidarPoint> points = frames.Points(frame.t_ns);
  const std::string categories = frames.Categories(points, frame.t_ns, own_);
  WriteWholeFile(frame.files.front(), NuScenesPointBytes(points));
  const bool is_labelled = frame.files.size() > 1;
  if (is_labelled) WriteWholeFile(frame.files.back(), categories);
  return frame;
}

std::string NuScenesScene::MountToken(std::size_t s, TimeNs t_ns) {
  const NuScenesSensor& sensor = rig_.sensors[s];
  const Pose X_BF = rig_.X_WB.At(t_ns).inverse() * sensor.X_WF(t_ns);
  const std::size_t list = first_sensor_ + s;
  Mount& mount = mounts_[s];
  const Pose moved = mount.X_BF.inverse() * X_BF;
  const bool is_same = mount.count > 0 && moved.translation().norm() <= kSameMount_m &&
                       Eigen::AngleAxisd(moved.linear()).angle() <= kSameMount_rad;
  if (!is_same) {
    mount = {X_BF, mount.count + 1};
    tables_->Add(NuTable::kCalibratedSensor,
                 {{"token", tokens_.Of(NuTable::kCalibratedSensor, list, mount.count - 1)},
                  {"sensor_token", tokens_.Of(NuTable::kSensor, list, 0)},
                  {"translation", TranslationJson(X_BF)},
                  {"rotation", RotationJson(X_BF)},
                  {"camera_intrinsic", IntrinsicJson(sensor.lens)}});
  }
  return tokens_.Of(NuTable::kCalibratedSensor, list, mount.count - 1);
}

}  // namespace tera
