#include "dataset/format/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <future>
#include <string_view>
#include <utility>
#include <vector>

#include "core/beside.h"
#include "core/check.h"
#include "core/config/config.h"
#include "core/error.h"
#include "core/parse_number.h"
#include "core/types/label_channels.h"
#include "core/types/sample_rows.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/channel.h"
#include "dataset/format/csv_rows.h"
#include "dataset/format/events_table.h"
#include "dataset/format/object_boxes.h"
#include "dataset/format/pcd.h"
#include "dataset/format/png.h"
#include "dataset/format/recorded_inputs.h"
#include "dataset/format/row_scan.h"

namespace tera {
namespace {

/// A channel type that this file knows.
struct ChannelType {
  std::string_view name;
  ChannelForm form;
  bool is_sensor;
};

constexpr std::array<ChannelType, 8> kChannelTypes = {
    {{kImuChannel, ChannelForm::kRows, true},
     {kGnssChannel, ChannelForm::kRows, true},
     {kEncoderChannel, ChannelForm::kRows, true},
     {kCameraChannel, ChannelForm::kPictures, true},
     {kLidarChannel, ChannelForm::kScans, true},
     {kTableChannel, ChannelForm::kRows, false},
     {kPoseChannel, ChannelForm::kRows, false},
     {kEventsChannel, ChannelForm::kRows, false}}};

}  // namespace
namespace fs = std::filesystem;
namespace {

std::vector<RowSample> RowsOf(RowScan* scan) {
  std::vector<RowSample> rows;
  for (ScannedRow row; scan->Next(&row);) rows.push_back({row.t_ns, row.t_ns, row.values});
  return rows;
}

Vec3 Vector3(const ScannedRow& row, std::size_t first) {
  return {row.values[first], row.values[first + 1], row.values[first + 2]};
}

Mat3 Rotation(const RowScan& scan, const ScannedRow& row, std::size_t first) {
  const Quat q(row.values[first], row.values[first + 1], row.values[first + 2],
               row.values[first + 3]);
  if (std::abs(q.norm() - 1.0) > kQuaternionTolerance) {
    scan.Fail(fmt::format("found a quaternion of norm {}; need norm 1", q.norm()));
  }
  return q.normalized().toRotationMatrix();
}

std::uint64_t Seed(const ConfigMap& map) {
  const std::string text = map.Text("seed");
  const auto seed = ParseNumber<std::uint64_t>(text);
  if (!seed)
    map.Fault("seed",
              {FaultKind::kMistyped, fmt::format("'{}' is not a whole number from 0", text)});
  return seed.value_or(0);
}

void ReadOrigin(const ConfigMap& map, DatasetInfo* info) {
  info->origin_lat_deg = map.Number("lat_deg", Between(-90, 90, "deg"));
  info->origin_lon_deg = map.Number("lon_deg", Between(-180, 180, "deg"));
  info->origin_height_m = map.Number("height_m", Any("m"));
}

DatasetInfo ReadInfo(const ConfigMap& root) {
  DatasetInfo info;
  if (root.Integer("format", AtLeast(1, "")) != kDatasetFormat) {
    root.Fault("format", fmt::format("need format {}; read this recording with the TERA version "
                                     "that wrote it",
                                     kDatasetFormat));
  }
  root.Text("tera_version");
  info.scenario_name = root.Text("name");
  info.simulated = root.Boolean("simulated", true);
  info.seed = Seed(root);
  info.duration_s = root.Number("duration_s", AtLeast(0, "s"));
  ReadOrigin(root.Map("origin"), &info);
  info.epoch = ReadEpoch(root);
  for (const ConfigMap& item : root.List("classes")) {
    const auto id = static_cast<std::size_t>(item.Integer("id", Between(0, 255, "")));
    const std::string name = item.Text("name");
    if (id < kSemanticClasses.size() && kSemanticClasses[id].name != name) {
      item.Fault("name", fmt::format("'{}' is class {} here, need '{}'", name, id,
                                     kSemanticClasses[id].name));
    }
  }
  for (const ConfigMap& item : root.List("instances")) {
    info.instances.push_back(
        {static_cast<std::uint16_t>(item.Integer("id", Between(0, 65535, ""))), item.Text("name"),
         item.Text("class"),
         static_cast<std::uint16_t>(item.Integer("parent", Between(0, 65535, ""), 0))});
  }
  info.inputs = ReadInputs(root);
  return info;
}

/// The sensor kind named in sensor.yaml; empty without that file.
std::string KindOfSensor(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder / "sensor.yaml", ignored)) return "";
  return Config::FromFile(folder / "sensor.yaml").root().Text("type", "");
}

/// Index of a type in kChannelTypes; the size of the table for any other type.
std::size_t PlaceOf(std::string_view type) {
  const auto found = std::find_if(kChannelTypes.begin(), kChannelTypes.end(),
                                  [&](const ChannelType& known) { return known.name == type; });
  return static_cast<std::size_t>(found - kChannelTypes.begin());
}

template <std::size_t... places>
std::string ChooseType(const ConfigMap& map, std::index_sequence<places...>) {
  return map.Choice("type", {kChannelTypes[places].name...}, kTableChannel);
}

/// The type of a channel. A type outside kChannelTypes must be the sensor kind named in the
/// channel's sensor.yaml.
std::string ReadType(const ConfigMap& map, const fs::path& channel) {
  const std::string type = map.Text("type", kTableChannel);
  const bool known = PlaceOf(type) < kChannelTypes.size();
  if (!known && !type.empty() && KindOfSensor(channel) == type) return type;
  return ChooseType(map, std::make_index_sequence<kChannelTypes.size()>());
}

/// Infers the form of a channel with another type from its files. A channel of frames has a frame
/// list in data.csv; a channel of scans also has a folder for scans.
ChannelForm FormOfFiles(const fs::path& folder) {
  std::ifstream csv(folder / "data.csv");
  std::string header;
  std::getline(csv, header);
  if (header != kFrameHeader) return ChannelForm::kRows;
  return fs::is_directory(folder / "scans") ? ChannelForm::kScans : ChannelForm::kPictures;
}

TableRecording ReadTable(RowScan* scan) {
  TableRecording table;
  table.columns = scan->columns();
  for (ScannedRow row; scan->Next(&row);) {
    table.t_ns.push_back(row.t_ns);
    table.rows.push_back(row.values);
  }
  return table;
}

TableRecording ReadTable(const fs::path& file) {
  RowScan scan(file);
  return ReadTable(&scan);
}

}  // namespace

bool WasStopped(const fs::path& directory) {
  std::error_code ignored;
  return !fs::is_regular_file(directory / "dataset.yaml", ignored) &&
         fs::exists(directory / "INCOMPLETE.txt", ignored);
}

TableRecording LoadStoppedTable(const fs::path& directory, const std::string& file) {
  fs::path path = directory / file;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) path += kPartSuffix;
  RowScan scan(path, [&](RowFault fault, int line, const std::string& what) {
    if (fault == RowFault::kCutOff) return;
    throw InputError(fmt::format("{}:{}", path.string(), line), {FaultKind::kMalformed, what});
  });
  return ReadTable(&scan);
}

std::vector<RecordedInput> LoadInputs(const fs::path& directory) {
  std::error_code ignored;
  if (fs::is_regular_file(directory / "dataset.yaml", ignored))
    return Recording(directory).info().inputs;
  if (!fs::is_regular_file(directory / kInputsOfStoppedName, ignored)) return {};
  const Config config = Config::FromFile(directory / kInputsOfStoppedName);
  std::vector<RecordedInput> inputs = ReadInputs(config.root());
  config.Finish();
  return inputs;
}

Recording::Recording(const fs::path& directory) : directory_(directory) {
  std::error_code ignored;
  if (!fs::is_directory(directory, ignored)) {
    throw InputError(directory.string(), {FaultKind::kUnreadable,
                                          fs::exists(directory, ignored)
                                              ? "is a file; need the folder of a recording that "
                                                "`tera generate` or `tera import` wrote"
                                              : "no such folder; name the folder of a recording"});
  }
  if (!fs::is_regular_file(directory / "dataset.yaml", ignored)) {
    const bool incomplete = WasStopped(directory);
    throw InputError(directory.string(),
                     {FaultKind::kMalformed,
                      fmt::format("is not a complete recording ({}); {}",
                                  incomplete ? "its run was interrupted" : "it has no dataset.yaml",
                                  incomplete ? "its INCOMPLETE.txt gives the remedy"
                                             : "name the folder with dataset.yaml")});
  }
  const Config config = Config::FromFile(directory / "dataset.yaml");
  const ConfigMap root = config.root();
  info_ = ReadInfo(root);
  for (const ConfigMap& item : root.List("channels")) {
    const std::string path = item.Text("path");
    channels_.push_back({path, ReadType(item, directory / path)});
  }
  config.Finish();
  if (fs::exists(directory / "scenario.yaml", ignored)) {
    info_.resolved_scenario_yaml = ReadWholeFile(directory / "scenario.yaml");
  }
}

bool Recording::Has(const std::string& path) const {
  return std::any_of(channels_.begin(), channels_.end(),
                     [&](const ChannelDescription& c) { return c.path == path; });
}

std::vector<std::string> Recording::ChannelsOf(std::string_view type) const {
  std::vector<std::string> paths;
  for (const ChannelDescription& channel : channels_) {
    if (channel.type == type) paths.push_back(channel.path);
  }
  return paths;
}

std::vector<std::string> Recording::SensorsOf(ChannelForm form) const {
  std::vector<std::string> paths;
  for (std::size_t place = 0; place <= kChannelTypes.size(); ++place) {
    for (const ChannelDescription& channel : channels_) {
      if (PlaceOf(channel.type) != place) continue;
      const bool known = place < kChannelTypes.size();
      if (known && !kChannelTypes[place].is_sensor) continue;
      if (form == (known ? kChannelTypes[place].form : FormOfFiles(directory_ / channel.path))) {
        paths.push_back(channel.path);
      }
    }
  }
  return paths;
}

std::vector<std::string> Recording::SeriesChannels() const {
  std::vector<std::string> paths = SensorsOf(ChannelForm::kRows);
  std::erase_if(paths, [&](const std::string& path) { return TypeOf(path) == kGnssChannel; });
  return paths;
}

std::string_view Recording::TypeOf(const std::string& path) const {
  const auto found = std::find_if(channels_.begin(), channels_.end(),
                                  [&](const ChannelDescription& c) { return c.path == path; });
  TERA_CHECK(found != channels_.end(), path);
  return found->type;
}

std::vector<std::string> Recording::Machines() const {
  std::vector<std::string> names;
  for (const ChannelDescription& channel : channels_) {
    fs::path path(channel.path);
    auto part = path.begin();
    const bool is_truth = *part == "truth";
    if (is_truth) ++part;
    if (std::next(part) == path.end()) continue;
    if (is_truth && info_.simulated && !Has(part->string() + "/commands.csv")) continue;
    if (std::find(names.begin(), names.end(), *part) == names.end()) names.push_back(*part);
  }
  return names;
}

std::vector<ImuSample> Recording::LoadImu(const std::string& folder) const {
  RowScan scan(directory_ / folder / "data.csv");
  scan.RequireColumns(ImuColumns());
  std::vector<ImuSample> samples;
  for (const RowSample& row : RowsOf(&scan)) samples.push_back(ImuSampleOf(row));
  return samples;
}

std::vector<GnssSample> Recording::LoadGnss(const std::string& folder) const {
  const std::vector<std::string> columns = GnssColumns();
  const auto fix =
      static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "fix") - columns.begin());
  RowScan scan(directory_ / folder / "data.csv");
  scan.RequireColumns(columns);
  std::vector<GnssSample> samples;
  for (ScannedRow row; scan.Next(&row);) {
    if (!FixOfQuality(row.values[fix])) {
      scan.Fail(fmt::format("column 'fix': found '{}', {}", row.values[fix], kNeedFix));
    }
    samples.push_back(GnssSampleOf({row.t_ns, row.t_ns, row.values}));
  }
  return samples;
}

EncoderRecording Recording::LoadEncoder(const std::string& folder) const {
  constexpr std::string_view kAngleEnding = "_rad", kTravelEnding = "_m";
  RowScan scan(directory_ / folder / "data.csv");
  EncoderRecording encoder;
  const std::size_t n = scan.columns().size() / 2;  // position columns, then rate columns
  for (std::size_t c = 0; c < n; ++c) {
    const std::string& column = scan.columns()[c];
    const bool linear = column.ends_with(kTravelEnding);
    if (!linear && !column.ends_with(kAngleEnding)) {
      scan.Fail(
          fmt::format("column '{}' is neither an angle (_rad) nor a travel (_m); need "
                      "positions of all joints, then their rates",
                      column));
    }
    const std::size_t ending = linear ? kTravelEnding.size() : kAngleEnding.size();
    encoder.axes.push_back({column.substr(0, column.size() - ending), linear});
  }
  scan.RequireColumns(EncoderColumns(encoder.axes));
  for (const RowSample& row : RowsOf(&scan)) encoder.samples.push_back(EncoderSampleOf(row));
  return encoder;
}

TableRecording Recording::LoadRows(const std::string& folder) const {
  return ReadTable(directory_ / folder / "data.csv");
}

PoseRecording Recording::LoadPose(const std::string& file) const {
  PoseRecording recording;
  RowScan scan(directory_ / file);
  recording.has_velocity = scan.columns().size() != PoseColumns(false).size();
  scan.RequireColumns(PoseColumns(recording.has_velocity));
  for (ScannedRow row; scan.Next(&row);) {
    TruthPose pose;
    pose.t_ns = row.t_ns;
    pose.X_WB = MakePose(Vector3(row, 0), Rotation(scan, row, 3));
    if (recording.has_velocity) {
      pose.v_WB_mps = Vector3(row, 7);
      pose.w_WB_B_radps = Vector3(row, 10);
    }
    recording.poses.push_back(pose);
  }
  return recording;
}

TableRecording Recording::LoadTable(const std::string& file) const {
  return ReadTable(directory_ / file);
}

std::vector<TimeNs> Recording::FrameTimes(const std::string& folder) const {
  RowScan scan(directory_ / folder / "data.csv");
  scan.RequireColumns({"filename"});
  std::vector<TimeNs> times;
  for (ScannedRow row; scan.Next(&row);) times.push_back(row.t_ns);
  return times;
}

CameraFrame Recording::LoadFrame(const std::string& folder, TimeNs t_ns) const {
  CameraFrame frame;
  frame.t_ns = frame.t_available_ns = t_ns;
  const auto file = [&](std::string_view kind, const char* ending) {
    return directory_ / folder / kind / fmt::format("{}.{}", t_ns, ending);
  };
  bool any = false;
  const auto has = [&](const fs::path& path) {
    std::error_code ignored;
    const bool there = fs::exists(path, ignored);
    any = any || there;
    return there;
  };
  // Decoding takes most of the time, so images are decoded in parallel.
  PreparePng();
  std::vector<std::future<void>> decoded;
  const auto decode = [&](const fs::path& png, auto read) {
    if (has(png)) decoded.push_back(Beside([png, read] { read(png); }));
  };
  decode(file("rgb", "png"), [&](const fs::path& png) { frame.rgb = ReadRgbPng(png); });
  decode(file("depth", "png"),
         [&](const fs::path& png) { frame.depth_m = DepthMetres(ReadGrey16Png(png)); });
  ForEachLabel(frame, [&](const LabelChannel& channel, auto& picture) {
    decode(file(channel.name, "png"), [components = channel.components, own = &picture](
                                          const fs::path& png) { ReadPng(png, components, own); });
  });
  if (has(file("boxes", "json"))) ReadBoxes(file("boxes", "json"), &frame);
  for (std::future<void>& picture : decoded) picture.get();
  if (!any) {
    throw InputError((directory_ / folder).string(),
                     {FaultKind::kMissing,
                      fmt::format("the image of t_ns {} is missing, but data.csv lists it", t_ns)});
  }
  return frame;
}

LidarScan Recording::LoadScan(const std::string& folder, TimeNs t_ns) const {
  return {t_ns, t_ns, ReadPcd(directory_ / folder / "scans" / fmt::format("{}.pcd", t_ns))};
}

}  // namespace tera
