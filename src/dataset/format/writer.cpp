#include "dataset/format/writer.h"

#include <fmt/format.h>

#include <atomic>
#include <set>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/types/label_channels.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/folder_lock.h"
#include "dataset/files/frame_log.h"
#include "dataset/files/frame_queue.h"
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

/// Text of the note in an incomplete directory. Equal runs have equal notes, independent of the
/// path.
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
  throw InputError(
      file.string(),
      fmt::format("the incomplete recording has another scenario, seed, version or other inputs; "
                  "resume it with the original ones, or delete {} to start afresh",
                  file.parent_path().string()));
}

/// The part of `text` between two marks; nullopt if a mark is missing.
std::string Between(const std::string& text, std::string_view before, std::string_view after) {
  const std::size_t first = text.find(before), begin = first + before.size();
  const std::size_t end = first == text.npos ? text.npos : text.find(after, begin);
  return end == text.npos ? "" : text.substr(begin, end - begin);
}

/// Throws InputError if the directory's note differs: another command began the directory, and this
/// one cannot complete it.
void NeedSameNote(const fs::path& root, const std::string& now) {
  const std::string there = Exists(root / kNoteName) ? ReadWholeFile(root / kNoteName) : "";
  const std::string remedy = Between(there, kToDo, ".\n");
  if (!remedy.empty() && remedy != Between(now, kToDo, ".\n")) {
    throw InputError(root.string(),
                     {FaultKind::kUnwritable,
                      fmt::format("holds an incomplete {}, which --resume cannot finish; {}",
                                  Between(there, "This ", kKindEnds), remedy)});
  }
  NeedSame(root / kNoteName, now);
}

void RemoveNotes(const fs::path& root) {
  Remove(root / kInputsOfStoppedName);
  Remove(root / kNoteName);
}

/// Deletes temporary files that a killed run left.
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
  ChannelForm form = ChannelForm::kRows;
  std::size_t columns = 0;  ///< row columns without t_ns
  std::unique_ptr<CheckedFile> csv;
  TimeNs last_ns = 0;
  bool any_rows = false;
};

/// File names of the frames of one channel form.
struct FrameFiles {
  std::string_view ending;  ///< extension of the file names in data.csv
  std::vector<std::string_view> folders;
};

/// Image folders of a camera without label channels.
std::vector<std::string_view> PictureFolders() {
  std::vector<std::string_view> folders = {"rgb", "depth"};
  for (const LabelChannel& channel : kLabelChannels) {
    if (channel.is_usual) folders.push_back(channel.name);
  }
  folders.push_back("boxes");
  return folders;
}

const FrameFiles& FilesOf(ChannelForm form) {
  static const FrameFiles rows, scans{"pcd", {"scans"}}, pictures{"png", PictureFolders()};
  if (form == ChannelForm::kRows) return rows;
  return form == ChannelForm::kScans ? scans : pictures;
}

std::string FrameName(TimeNs t_ns, ChannelForm form) {
  return fmt::format("{}.{}", t_ns, FilesOf(form).ending);
}

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
  std::unique_ptr<FrameQueue> queue;  // last member: its threads must end before the data they use

  void Begin(const WriterOptions& options);
  void WriteNotes();
  /// `text` is the beginning of the channel's table, or the whole table.
  ChannelId Add(const ChannelInfo& info, std::string_view text);
  Channel& Find(ChannelId id);
  void Write(Channel* channel, const RowSample& row);
  void Write(Channel* channel, CameraFrame frame);
  void Write(Channel* channel, LidarScan scan);
  void AddRow(Channel* channel, TimeNs t_ns, const std::string& row);
  FrameLog::File WriteFile(const std::string& name, const std::string& bytes);
  void WriteCamera(const std::string& folder, const CameraFrame& frame);
  void WriteScan(const std::string& folder, const LidarScan& scan);
};

void DatasetWriter::Impl::Begin(const WriterOptions& options) {
  const fs::path name = final_directory.filename();
  if (name.empty() || name == "." || name == "..") {
    throw InputError(
        "", {FaultKind::kUnwritable,
             fmt::format("'{}': does not name a new folder; give the recording's folder a name",
                         final_directory.string())});
  }
  RequireNothingAt(final_directory);
  resumed = HoldsSomething(root);
  if (resumed) lock = std::make_unique<FolderLock>(root);
  if (resumed && !options.resume) {
    throw InputError(
        root.string(),
        {FaultKind::kUnwritable, fmt::format("holds an incomplete recording; {}", options.remedy)});
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

std::string HeaderOf(const ChannelInfo& info) {
  return info.form == ChannelForm::kRows ? TableHeader(info.columns) : std::string(kFrameHeader);
}

ChannelId DatasetWriter::Impl::Add(const ChannelInfo& info, std::string_view text) {
  TERA_CHECK(paths.insert(info.path).second, info.path);
  const std::string csv = info.sensor_yaml ? info.path + "/data.csv" : info.path;
  MakeFolder((root / csv).parent_path());
  Channel channel;
  channel.description = {info.path, info.type};
  channel.form = info.form;
  channel.columns = info.columns.size();
  channel.csv = std::make_unique<CheckedFile>(root / csv);
  channel.csv->Append(text);
  if (info.sensor_yaml) WriteWholeFile(root / info.path / "sensor.yaml", *info.sensor_yaml);
  for (const std::string_view folder : FilesOf(info.form).folders) {
    MakeFolder(root / info.path / folder);
  }
  channels.push_back(std::move(channel));
  return static_cast<ChannelId>(channels.size()) - 1;
}

Channel& DatasetWriter::Impl::Find(ChannelId id) {
  TERA_CHECK(id >= 0 && id < static_cast<ChannelId>(channels.size()), id);
  return channels[static_cast<std::size_t>(id)];
}

void DatasetWriter::Impl::Write(Channel* channel, const RowSample& row) {
  TERA_CHECK(channel->form == ChannelForm::kRows, channel->description.path);
  TERA_CHECK(row.values.size() == channel->columns, channel->description.path, row.values.size());
  AddRow(channel, row.t_ns, RowText(row));
}

void DatasetWriter::Impl::Write(Channel* channel, CameraFrame frame) {
  TERA_CHECK(channel->form == ChannelForm::kPictures, channel->description.path);
  AddRow(channel, frame.t_ns, FrameRowText(frame.t_ns, FrameName(frame.t_ns, channel->form)));
  queue->Push([this, folder = channel->description.path, frame = std::move(frame)] {
    WriteCamera(folder, frame);
  });
}

void DatasetWriter::Impl::Write(Channel* channel, LidarScan scan) {
  TERA_CHECK(channel->form == ChannelForm::kScans, channel->description.path);
  AddRow(channel, scan.t_ns, FrameRowText(scan.t_ns, FrameName(scan.t_ns, channel->form)));
  queue->Push([this, folder = channel->description.path, scan = std::move(scan)] {
    WriteScan(folder, scan);
  });
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
  const auto name = [&](std::string_view kind, const char* ending) {
    return fmt::format("{}/{}/{}.{}", folder, kind, frame.t_ns, ending);
  };
  if (!frame.rgb.empty()) files.push_back(WriteFile(name("rgb", "png"), EncodeRgbPng(frame.rgb)));
  if (!frame.depth_m.empty()) {
    files.push_back(
        WriteFile(name("depth", "png"), EncodeGrey16Png(DepthMillimetres(frame.depth_m))));
  }
  ForEachLabel(frame, [&](const LabelChannel& channel, const auto& picture) {
    if (picture.empty()) return;
    if (!channel.is_usual) MakeFolder(root / folder / channel.name);
    files.push_back(WriteFile(name(channel.name, "png"), EncodePng(picture)));
  });
  if (!frame.instance.empty()) {
    files.push_back(WriteFile(name("boxes", "json"), EncodeBoxes(frame)));
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
  if (!Exists(root / kDescriptionName)) return false;  // dataset.yaml is written last
  const FolderLock lock(root);
  // If the note is already deleted, the scenario still identifies the run: it contains seed and
  // duration.
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

ChannelId DatasetWriter::AddChannel(const ChannelInfo& info) {
  return impl_->Add(info, HeaderOf(info) + "\n");
}

void DatasetWriter::AddWholeTable(const ChannelInfo& info, const fs::path& file) {
  TERA_CHECK(info.form == ChannelForm::kRows, info.path);
  const std::string text = ReadWholeFile(file);
  if (!text.starts_with(HeaderOf(info) + "\n")) {
    throw InputError(file.string(), {FaultKind::kInconsistent,
                                     fmt::format("has other columns than the scenario; need '{}'",
                                                 HeaderOf(info))});
  }
  AddWholeText(info, text);
}

void DatasetWriter::AddWholeText(const ChannelInfo& info, const std::string& text) {
  TERA_CHECK(text.starts_with(HeaderOf(info) + "\n"), info.path);
  impl_->Add(info, text);
  impl_->row_bytes += static_cast<std::int64_t>(text.size());
}

void DatasetWriter::Write(ChannelId channel, Measurement measurement) {
  Channel* found = &impl_->Find(channel);
  std::visit([&](auto&& measured) { impl_->Write(found, std::move(measured)); },
             std::move(measurement));
}

bool DatasetWriter::NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs) const {
  return !impl_->frame_log->WasWhole(impl_->Find(channel).description.path, t_ns);
}

void DatasetWriter::MarkPresent(ChannelId channel, TimeNs t_ns) {
  TERA_CHECK(!NeedsFrame(channel, t_ns, t_ns), channel, t_ns);
  Channel& frames = impl_->Find(channel);
  impl_->AddRow(&frames, t_ns, FrameRowText(t_ns, FrameName(t_ns, frames.form)));
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
