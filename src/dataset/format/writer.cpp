#include "dataset/format/writer.h"

#include <fmt/format.h>

#include <atomic>
#include <set>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/folder_lock.h"
#include "dataset/files/frame_log.h"
#include "dataset/files/frame_queue.h"
#include "dataset/files/whole_folder.h"
#include "dataset/format/csv_rows.h"
#include "dataset/format/dataset_description.h"
#include "dataset/format/object_boxes.h"
#include "dataset/format/pcd.h"
#include "dataset/format/png.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr char kNoteName[] = "INCOMPLETE.txt";
constexpr char kScenarioName[] = "scenario.yaml";
constexpr char kDescriptionName[] = "dataset.yaml";

constexpr std::string_view kKindEnds = " is not complete: ", kToDo = "\nWhat to do: ";

/// Says what is in an incomplete directory; the same for the same run, whatever its place.
std::string Note(const DatasetInfo& info, const WriterOptions& options) {
  return fmt::format(
      "This {}{}the run that writes it was stopped, or is still going on."
      "{}{}.\n\n"
      "scenario: {}\nseed: {}\nduration_s: {}\nTERA: {}\n",
      options.kind, kKindEnds, kToDo, options.remedy, info.scenario_name, info.seed,
      info.duration_s, TeraVersion());
}

bool Exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

void Remove(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) FailFile(path, "cannot be removed", error.value());
}

void NeedSame(const fs::path& file, const std::string& now) {
  if (Exists(file) && ReadWholeFile(file) == now) return;
  throw InputError(fmt::format(
      "{}: the incomplete recording is of another scenario, seed or version, or of other "
      "inputs; resume it with what it was begun with, or delete {} to start afresh",
      file.string(), file.parent_path().string()));
}

/// What stands in `text` between two marks, or nothing.
std::string Between(const std::string& text, std::string_view before, std::string_view after) {
  const std::size_t first = text.find(before), begin = first + before.size();
  const std::size_t end = first == text.npos ? text.npos : text.find(after, begin);
  return end == text.npos ? "" : text.substr(begin, end - begin);
}

/// Also tells what another command than this has begun, which this one cannot finish.
void NeedSameNote(const fs::path& root, const std::string& now) {
  const std::string there = Exists(root / kNoteName) ? ReadWholeFile(root / kNoteName) : "";
  const std::string remedy = Between(there, kToDo, ".\n");
  if (!remedy.empty() && remedy != Between(now, kToDo, ".\n")) {
    throw InputError(fmt::format("{}: holds an incomplete {}, which --resume cannot finish; {}",
                                 root.string(), Between(there, "This ", kKindEnds), remedy));
  }
  NeedSame(root / kNoteName, now);
}

void RemoveNotes(const fs::path& root) {
  Remove(root / kInputsOfStoppedName);
  Remove(root / kNoteName);
}

/// Temporary files of a killed run.
void RemoveParts(const fs::path& root) {
  std::vector<fs::path> parts;
  std::error_code error;
  fs::recursive_directory_iterator entry(root, error);
  for (; !error && entry != fs::end(entry); entry.increment(error)) {
    if (entry->path().string().ends_with(kPartSuffix)) parts.push_back(entry->path());
  }
  if (error) FailFile(root, "cannot be listed", error.value());
  for (const fs::path& part : parts) Remove(part);
}

struct Channel {
  ChannelDescription description;
  std::unique_ptr<CheckedFile> csv;
  std::size_t value_count = 0;  ///< numbers in a row after t_ns; 0 where the type fixes it
  bool with_velocity = true;
  TimeNs last_ns = 0;
  bool any_rows = false;
};

}  // namespace

struct DatasetWriter::Impl {
  fs::path final_directory, root;
  DatasetInfo info;
  std::string note;
  bool resumed = false;
  std::vector<Channel> channels;
  std::set<std::string> paths;
  std::unique_ptr<FolderLock> lock;
  std::unique_ptr<FrameLog> frame_log;
  std::atomic<std::int64_t> frames_written = 0, frame_bytes = 0;
  std::int64_t row_bytes = 0;
  std::unique_ptr<FrameQueue> queue;  // last, so that its threads end before what they use

  void Begin(const WriterOptions& options);
  void WriteNotes();
  ChannelId Add(ChannelType type, const std::string& path, const std::string& csv,
                std::string_view header);
  ChannelId AddSensor(ChannelType type, const std::string& folder, const std::string& sensor_yaml,
                      std::string_view header, const std::vector<std::string>& subfolders);
  Channel& Find(ChannelId id, ChannelType type);
  void AddRow(Channel* channel, TimeNs t_ns, const std::string& row);
  FrameLog::File WriteFile(const std::string& name, const std::string& bytes);
  void WriteCamera(const std::string& folder, const CameraFrame& frame);
  void WriteScan(const std::string& folder, const LidarScan& scan);
};

void DatasetWriter::Impl::Begin(const WriterOptions& options) {
  const fs::path name = final_directory.filename();
  if (name.empty() || name == "." || name == "..") {
    throw InputError(
        fmt::format("'{}': names no folder of its own; give the recording's folder a name",
                    final_directory.string()));
  }
  if (HoldsSomething(final_directory)) {
    throw InputError(fmt::format("{}: is not an empty directory; choose another place or delete it",
                                 final_directory.string()));
  }
  resumed = HoldsSomething(root);
  if (resumed) lock = std::make_unique<FolderLock>(root);
  if (resumed && !options.resume) {
    throw InputError(
        fmt::format("{}: holds an incomplete recording; {}", root.string(), options.remedy));
  }
  if (resumed) {
    NeedSameNote(root, note);
    NeedSame(root / kScenarioName, info.resolved_scenario_yaml);
    NeedSame(root / kInputsOfStoppedName, InputsYaml(info.inputs));
    RemoveParts(root);
  } else {
    WriteNotes();
    lock = std::make_unique<FolderLock>(root);
  }
  frame_log = std::make_unique<FrameLog>(root);
}

void DatasetWriter::Impl::WriteNotes() {
  MakeFolder(root);
  try {
    WriteWholeFile(root / kScenarioName, info.resolved_scenario_yaml);
    WriteWholeFile(root / kInputsOfStoppedName, InputsYaml(info.inputs));
    WriteWholeFile(root / kNoteName, note);
  } catch (const InputError&) {
    std::error_code ignored;
    fs::remove_all(root, ignored);
    throw;
  }
}

ChannelId DatasetWriter::Impl::Add(ChannelType type, const std::string& path,
                                   const std::string& csv, std::string_view header) {
  TERA_CHECK(paths.insert(path).second, path);
  MakeFolder((root / csv).parent_path());
  Channel channel;
  channel.description = {path, type};
  channel.csv = std::make_unique<CheckedFile>(root / csv);
  channel.csv->Append(header);
  channel.csv->Append("\n");
  channels.push_back(std::move(channel));
  return static_cast<ChannelId>(channels.size()) - 1;
}

ChannelId DatasetWriter::Impl::AddSensor(ChannelType type, const std::string& folder,
                                         const std::string& sensor_yaml, std::string_view header,
                                         const std::vector<std::string>& subfolders) {
  const ChannelId id = Add(type, folder, folder + "/data.csv", header);
  WriteWholeFile(root / folder / "sensor.yaml", sensor_yaml);
  for (const std::string& subfolder : subfolders) MakeFolder(root / folder / subfolder);
  return id;
}

Channel& DatasetWriter::Impl::Find(ChannelId id, ChannelType type) {
  TERA_CHECK(id >= 0 && id < static_cast<ChannelId>(channels.size()), id);
  Channel& channel = channels[static_cast<std::size_t>(id)];
  TERA_CHECK(channel.description.type == type, channel.description.path, NameOf(type));
  return channel;
}

void DatasetWriter::Impl::AddRow(Channel* channel, TimeNs t_ns, const std::string& row) {
  TERA_CHECK(!channel->any_rows || t_ns > channel->last_ns, channel->description.path, t_ns,
             channel->last_ns);
  channel->any_rows = true;
  channel->last_ns = t_ns;
  channel->csv->Append(row);
  row_bytes += static_cast<std::int64_t>(row.size());
}

FrameLog::File DatasetWriter::Impl::WriteFile(const std::string& name, const std::string& bytes) {
  WriteWholeFile(root / name, bytes);
  frame_bytes += static_cast<std::int64_t>(bytes.size());
  return {name, static_cast<std::int64_t>(bytes.size())};
}

void DatasetWriter::Impl::WriteCamera(const std::string& folder, const CameraFrame& frame) {
  std::vector<FrameLog::File> files;
  const auto name = [&](const char* kind, const char* ending) {
    return fmt::format("{}/{}/{}.{}", folder, kind, frame.t_ns, ending);
  };
  if (!frame.rgb.empty()) files.push_back(WriteFile(name("rgb", "png"), EncodeRgbPng(frame.rgb)));
  if (!frame.depth_m.empty()) {
    files.push_back(
        WriteFile(name("depth", "png"), EncodeGrey16Png(DepthMillimetres(frame.depth_m))));
  }
  if (!frame.semantic.empty()) {
    files.push_back(WriteFile(name("semantic", "png"), EncodeGreyPng(frame.semantic)));
    files.push_back(WriteFile(name("boxes", "json"), EncodeBoxes(frame.t_ns, frame.boxes)));
  }
  if (!frame.instance.empty()) {
    files.push_back(WriteFile(name("instance", "png"), EncodeGrey16Png(frame.instance)));
  }
  TERA_CHECK(!files.empty(), folder, frame.t_ns);
  frame_log->Append(folder, frame.t_ns, files);
  ++frames_written;
}

void DatasetWriter::Impl::WriteScan(const std::string& folder, const LidarScan& scan) {
  const std::string name = fmt::format("{}/scans/{}.pcd", folder, scan.t_ns);
  frame_log->Append(folder, scan.t_ns, {WriteFile(name, EncodePcd(scan.points))});
  ++frames_written;
}

fs::path IncompleteOf(const fs::path& directory) {
  fs::path root = directory.has_filename() ? directory : directory.parent_path();
  root += ".incomplete";
  return root;
}

DatasetWriter::DatasetWriter(const fs::path& directory, const DatasetInfo& info,
                             const WriterOptions& options)
    : impl_(std::make_unique<Impl>()) {
  impl_->final_directory = directory.has_filename() ? directory : directory.parent_path();
  impl_->root = IncompleteOf(directory);
  impl_->info = info;
  impl_->note = Note(info, options);
  impl_->Begin(options);
  PreparePng();
  impl_->queue = std::make_unique<FrameQueue>(options.threads, options.queue_length);
}

DatasetWriter::~DatasetWriter() {
  for (Channel& channel : impl_->channels) channel.csv->Leave();
}

bool DatasetWriter::FinishWhole(const fs::path& directory, const DatasetInfo& info) {
  const fs::path root = IncompleteOf(directory);
  if (!Exists(root / kDescriptionName)) return false;  // written when all else is whole
  const FolderLock lock(root);
  // Where the note is gone already, the scenario tells the seed and the duration too.
  if (Exists(root / kNoteName)) NeedSameNote(root, Note(info, WriterOptions()));
  NeedSame(root / kScenarioName, info.resolved_scenario_yaml);
  if (Exists(root / kInputsOfStoppedName)) {
    NeedSame(root / kInputsOfStoppedName, InputsYaml(info.inputs));
  }
  FrameLog(root).Remove();
  RemoveNotes(root);
  GiveName(root, directory.has_filename() ? directory : directory.parent_path());
  return true;
}

ChannelId DatasetWriter::AddImu(const std::string& folder, const std::string& sensor_yaml) {
  return impl_->AddSensor(ChannelType::kImu, folder, sensor_yaml, kImuHeader, {});
}

ChannelId DatasetWriter::AddGnss(const std::string& folder, const std::string& sensor_yaml) {
  return impl_->AddSensor(ChannelType::kGnss, folder, sensor_yaml, kGnssHeader, {});
}

ChannelId DatasetWriter::AddEncoder(const std::string& folder, const std::string& sensor_yaml,
                                    const std::vector<EncoderAxis>& axes) {
  const std::string header = TableHeader(EncoderColumns(axes));
  const ChannelId id = impl_->AddSensor(ChannelType::kEncoder, folder, sensor_yaml, header, {});
  impl_->Find(id, ChannelType::kEncoder).value_count = axes.size();
  return id;
}

ChannelId DatasetWriter::AddCamera(const std::string& folder, const std::string& sensor_yaml) {
  return impl_->AddSensor(ChannelType::kCamera, folder, sensor_yaml, kFrameHeader,
                          {"rgb", "depth", "semantic", "instance", "boxes"});
}

ChannelId DatasetWriter::AddLidar(const std::string& folder, const std::string& sensor_yaml) {
  return impl_->AddSensor(ChannelType::kLidar, folder, sensor_yaml, kFrameHeader, {"scans"});
}

ChannelId DatasetWriter::AddTable(const std::string& file,
                                  const std::vector<std::string>& columns) {
  const std::string header = TableHeader(columns);
  const ChannelId id = impl_->Add(ChannelType::kTable, file, file, header);
  impl_->Find(id, ChannelType::kTable).value_count = columns.size();
  return id;
}

ChannelId DatasetWriter::AddPose(const std::string& file, bool with_velocity) {
  const ChannelId id = impl_->Add(ChannelType::kPose, file, file,
                                  with_velocity ? kPoseHeader : kReferencePoseHeader);
  impl_->Find(id, ChannelType::kPose).with_velocity = with_velocity;
  return id;
}

void DatasetWriter::Write(ChannelId channel, const ImuSample& sample) {
  impl_->AddRow(&impl_->Find(channel, ChannelType::kImu), sample.t_ns, ImuRow(sample));
}

void DatasetWriter::Write(ChannelId channel, const GnssSample& sample) {
  impl_->AddRow(&impl_->Find(channel, ChannelType::kGnss), sample.t_ns, GnssRow(sample));
}

void DatasetWriter::Write(ChannelId channel, const EncoderSample& sample) {
  Channel& encoder = impl_->Find(channel, ChannelType::kEncoder);
  TERA_CHECK(sample.q_rad.size() == encoder.value_count, sample.q_rad.size());
  TERA_CHECK(sample.qd_radps.size() == encoder.value_count, sample.qd_radps.size());
  impl_->AddRow(&encoder, sample.t_ns, EncoderRow(sample));
}

void DatasetWriter::Write(ChannelId channel, CameraFrame frame) {
  Channel& camera = impl_->Find(channel, ChannelType::kCamera);
  impl_->AddRow(&camera, frame.t_ns, FrameRow(frame.t_ns, fmt::format("{}.png", frame.t_ns)));
  impl_->queue->Push([impl = impl_.get(), folder = camera.description.path,
                      frame = std::move(frame)] { impl->WriteCamera(folder, frame); });
}

void DatasetWriter::Write(ChannelId channel, LidarScan scan) {
  Channel& lidar = impl_->Find(channel, ChannelType::kLidar);
  impl_->AddRow(&lidar, scan.t_ns, FrameRow(scan.t_ns, fmt::format("{}.pcd", scan.t_ns)));
  impl_->queue->Push([impl = impl_.get(), folder = lidar.description.path, scan = std::move(scan)] {
    impl->WriteScan(folder, scan);
  });
}

void DatasetWriter::Write(ChannelId channel, const TruthPose& pose) {
  Channel& poses = impl_->Find(channel, ChannelType::kPose);
  impl_->AddRow(&poses, pose.t_ns, PoseRow(pose, poses.with_velocity));
}

void DatasetWriter::WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values) {
  Channel& table = impl_->Find(channel, ChannelType::kTable);
  TERA_CHECK(values.size() == table.value_count, values.size(), table.value_count);
  impl_->AddRow(&table, t_ns, TableRow(t_ns, values));
}

bool DatasetWriter::NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs) const {
  TERA_CHECK(channel >= 0 && channel < static_cast<ChannelId>(impl_->channels.size()), channel);
  const std::string& folder = impl_->channels[static_cast<std::size_t>(channel)].description.path;
  return !impl_->frame_log->WasWhole(folder, t_ns);
}

void DatasetWriter::MarkPresent(ChannelId channel, TimeNs t_ns) {
  TERA_CHECK(!NeedsFrame(channel, t_ns, t_ns), channel, t_ns);
  Channel& frames = impl_->channels[static_cast<std::size_t>(channel)];
  const char* ending = frames.description.type == ChannelType::kLidar ? "pcd" : "png";
  impl_->AddRow(&frames, t_ns, FrameRow(t_ns, fmt::format("{}.{}", t_ns, ending)));
}

fs::path DatasetWriter::PathFor(const std::string& relative) {
  const fs::path path = impl_->root / relative;
  MakeFolder(path.parent_path());
  return path;
}

void DatasetWriter::Flush() {
  for (Channel& channel : impl_->channels) channel.csv->Flush();
}

std::int64_t DatasetWriter::frames_written() const { return impl_->frames_written; }

std::int64_t DatasetWriter::bytes_written() const { return impl_->frame_bytes + impl_->row_bytes; }

bool DatasetWriter::resumed() const { return impl_->resumed; }

const fs::path& DatasetWriter::incomplete_directory() const { return impl_->root; }

void DatasetWriter::SetDuration(double duration_s) { impl_->info.duration_s = duration_s; }

void DatasetWriter::Finish() {
  impl_->queue->Drain();
  std::vector<ChannelDescription> descriptions;
  for (Channel& channel : impl_->channels) {
    channel.csv->Commit();
    descriptions.push_back(channel.description);
  }
  WriteWholeFile(impl_->root / kDescriptionName, DatasetYaml(impl_->info, descriptions));
  impl_->frame_log->Remove();
  RemoveNotes(impl_->root);
  GiveName(impl_->root, impl_->final_directory);
}

void DatasetWriter::Discard() {
  impl_->queue.reset();
  impl_->channels.clear();
  impl_->frame_log.reset();
  std::error_code ignored;
  fs::remove_all(impl_->root, ignored);
}

}  // namespace tera
