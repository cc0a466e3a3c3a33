#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "app/progress/progress_bar.h"
#include "core/check.h"
#include "core/error.h"
#include "core/time.h"
#include "core/utc_time.h"
#include "dataset/export/export.h"
#include "dataset/format/recording.h"
#include "sim/joint_trees.h"
#include "sim/recorded_ground.h"

namespace tera {
namespace {

/// Accepts a UTC time like "2026-05-01T12:00:00Z" in the years 1970 to 2037.
CLI::Validator IsUtcTime() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        if (ParseUtc(text)) return "";
        return "'" + text +
               "'; need a date and time of UTC from 1970 to 2037, "
               "2026-05-01T12:00:00Z";
      },
      "UTC");
}

/// Converts a text accepted by IsUtcTime to nanoseconds since 1970-01-01 00:00:00.
TimeNs UtcTime(const std::string& text) {
  const std::optional<TimeNs> time_ns = ParseUtc(text);
  TERA_CHECK(time_ns, text);
  return *time_ns;
}

constexpr std::int64_t kBytesPerMb = 1'000'000;
constexpr int kMostShardMb = 1'000'000;
/// Default limit of threads. A thread holds two frames, about 50 MB for a large rig.
constexpr unsigned kMostByItself = 8;

/// Interval between progress lines if the output is not a terminal.
constexpr double kExportLine_s = 10;

struct ExportArguments {
  std::string dataset, out, start_utc;
  std::vector<std::string> moved;
  std::int64_t shard_mb = kDefaultShardBytes / kBytesPerMb;
  ExportOptions options;
};

const std::map<std::string, BagStorage> kStorages = {{"mcap", BagStorage::kMcap},
                                                     {"sqlite3", BagStorage::kSqlite3}};
const std::map<std::string, BagCompression> kCompressions = {{"zstd", BagCompression::kZstd},
                                                             {"lz4", BagCompression::kLz4},
                                                             {"none", BagCompression::kNone}};
const std::map<std::string, BagImages> kImages = {{"raw", BagImages::kRaw},
                                                  {"compressed", BagImages::kCompressed}};

std::map<std::string, KittiLayout> KittiLayoutsByName() {
  std::map<std::string, KittiLayout> layouts;
  for (const KittiLayoutName& entry : kKittiLayouts)
    layouts[std::string(entry.name)] = entry.layout;
  return layouts;
}

std::map<std::string, ExportFormat> FormatsByName() {
  std::map<std::string, ExportFormat> formats;
  for (const ExportFormatName& entry : kExportFormats) {
    formats[std::string(entry.name)] = entry.format;
  }
  return formats;
}

ExportReport ExportWithProgress(const ExportArguments& arguments) {
  ExportOptions options = arguments.options;
  options.joint_trees = [&] { return RecordedJointTrees(arguments.dataset, arguments.moved); };
  if (IsBag(options.format)) {
    options.read_ground = ReaderOfGround(Recording(arguments.dataset).info());
  }
  options.shard_bytes = arguments.shard_mb * kBytesPerMb;
  ProgressBar bar(kExportLine_s);
  if (!arguments.start_utc.empty()) options.start_utc_ns = UtcTime(arguments.start_utc);
  options.progress = [&](const ExportProgress& progress) {
    bar.Show({progress.recorded_s, progress.duration_s, progress.records}, "records");
  };
  return Export(arguments.dataset, arguments.out, options);
}

void RunExport(const ExportArguments& arguments) {
  const ExportReport report = ExportWithProgress(arguments);
  const std::string messages = IsBag(arguments.options.format)
                                   ? fmt::format("{} messages of ", report.messages)
                                   : std::string();
  fmt::print("{}: {}{} records in {} files, {:.1f} MB\n", arguments.out, messages, report.records,
             report.files, 1e-6 * static_cast<double>(report.bytes));
  if (report.absent.count == 0) return;
  fmt::print("  {} pictures are missing and have no message, the first: {}\n", report.absent.count,
             report.absent.first.string());
}

void AddBagOptions(CLI::App* command, ExportArguments* arguments) {
  ExportOptions* const options = &arguments->options;
  command->add_option("--storage", options->storage, "rosbag2: mcap (the default) or sqlite3")
      ->transform(OneOf(kStorages));
  command
      ->add_option("--compression", options->compression,
                   "MCAP: compression of chunks, zstd (the default), lz4 or none")
      ->transform(OneOf(kCompressions));
  command
      ->add_option("--images", options->images,
                   "bags: raw pixels (the default) or the compressed PNG files")
      ->transform(OneOf(kImages));
  AddMovedOption(command, &arguments->moved, "bags, clouds, nuscenes and formats of one lidar: ");
}

/// Adds options for formats with one camera and one lidar.
void AddKittiOptions(CLI::App* command, ExportArguments* arguments) {
  ExportOptions* const options = &arguments->options;
  command->add_option("--camera", options->camera, "kitti: MACHINE/CAMERA; without it the first");
  command->add_option(
      "--lidar", options->lidar,
      "kitti, semantickitti: MACHINE/LIDAR; without it the first. pcap: without it all");
  command
      ->add_option(
          "--layout", options->kitti_layouts,
          "kitti: raw, object, tracking, odometry and depth, or some of them; without it all")
      ->delimiter(',')
      ->transform(OneOf(KittiLayoutsByName()));
}

void AddWebdatasetOptions(CLI::App* command, ExportArguments* arguments) {
  command
      ->add_option("--shard-mb", arguments->shard_mb,
                   "webdataset: approximate size of an archive in MB; 256")
      ->check(CLI::Range(1, kMostShardMb));
  command->add_option("--card", arguments->options.card,
                      "webdataset: YAML file with description, license, url, date_published and "
                      "person or organization, for README.md and croissant.json");
}

void AddNuscenesOptions(CLI::App* command, ExportArguments* arguments) {
  constexpr double kMostKeyFrames_hz = 1000;
  command
      ->add_option("--key-frames-hz", arguments->options.key_frames_hz,
                   "nuscenes: rate of annotated key frames in Hz; 2")
      ->check(CLI::Range(1e-3, kMostKeyFrames_hz));
}

/// Throws InputError for an option that has no effect on the chosen format.
void RequireNoIdleOption(const CLI::App& command, const ExportOptions& options) {
  const auto require = [&](const std::string& option, bool is_used, const std::string& of) {
    if (command.count(option) == 0 || is_used) return;
    throw InputError(option,
                     {FaultKind::kUnknown,
                      fmt::format("has no effect here, only with {}; remove it, or use that", of)});
  };
  const bool bag = IsBag(options.format);
  const bool ros2 = options.format == ExportFormat::kRosbag2;
  require("--storage", ros2, "--to rosbag2");
  require("--images", bag, "bags");
  require("--compression", ros2 && options.storage == BagStorage::kMcap,
          "--to rosbag2 --storage mcap");
  require("--moved", UsesJointTrees(options.format),
          "bags, clouds, nuscenes and formats of one lidar");
  require("--lidar", ChoosesLidar(options.format), "--to kitti, semantickitti and pcap");
  require("--camera", IsOfOneCamera(options.format), "--to kitti");
  require("--card", options.format == ExportFormat::kWebdataset, "--to webdataset");
  require("--shard-mb", options.format == ExportFormat::kWebdataset, "--to webdataset");
  require("--start-utc", options.format != ExportFormat::kSemanticKitti, "formats that have dates");
  require("--key-frames-hz", options.format == ExportFormat::kNuscenes, "--to nuscenes");
  require("--layout", options.format == ExportFormat::kKitti, "--to kitti");
}

}  // namespace

void AddExportCommand(CLI::App* app) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      app->add_subcommand("export", "Write a dataset in a format that other programs read");
  command->add_option("DATASET", arguments->dataset, "Dataset directory")->required();
  command->add_option("--to", arguments->options.format, "Format, see docs/reference/export.md")
      ->required()
      ->transform(OneOf(FormatsByName()));
  command->add_option("--out", arguments->out, "Directory of the export; new")->required();
  command
      ->add_option("--start-utc", arguments->start_utc,
                   "Date and time of the recording's time 0, 2026-05-01T12:00:00Z; without it "
                   "times begin at 0, or in formats that need a date on 2024-01-01")
      ->check(IsUtcTime());
  command->add_flag(
      "--resume", arguments->options.resume,
      "Resume an interrupted export if the format has many files; otherwise start it again");
  arguments->options.threads =
      static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, kMostByItself));
  command->add_option("--threads", arguments->options.threads, "Frames at a time")
      ->check(WholeNumberBetween(1, 256));
  AddBagOptions(command, arguments.get());
  AddKittiOptions(command, arguments.get());
  AddWebdatasetOptions(command, arguments.get());
  AddNuscenesOptions(command, arguments.get());
  command->callback([arguments, command] {
    RequireNoIdleOption(*command, arguments->options);
    RunExport(*arguments);
  });
}

}  // namespace tera
