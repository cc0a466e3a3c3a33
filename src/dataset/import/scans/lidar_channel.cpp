#include "dataset/import/scans/lidar_channel.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/types/mounting.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/channel.h"
#include "dataset/import/imported_frames.h"
#include "dataset/import/scans/lidar_source.h"

namespace tera {
namespace {

constexpr double kWholeTurn = 0.95;  ///< fraction of a turn; a scan that covers less is counted as
                                     ///< incomplete

struct LidarPlan {
  std::string folder;
  ImportedSensor sensor;
  LidarSource source;
};

/// Counts over all imported scans.
struct ScanTally {
  std::int64_t rays = 0, points = 0, second_returns = 0, cut = 0;
  double least_turn = 1;
};

void Count(const UnitScan& scan, ScanTally* tally) {
  tally->rays += scan.rays;
  tally->points += static_cast<std::int64_t>(scan.scan.points.size());
  tally->second_returns += scan.second_returns;
  tally->cut += scan.turn < kWholeTurn ? 1 : 0;
  tally->least_turn = std::min(tally->least_turn, scan.turn);
}

std::vector<std::string> RemarksOn(const ScanTally& tally, std::size_t scans,
                                   const LidarSource& source) {
  std::vector<std::string> remarks;
  const std::int64_t seen = tally.points - (source.keeps_seconds ? tally.second_returns : 0);
  if (tally.rays > 0) {
    remarks.push_back(fmt::format(
        "{} points; {:.1f} % of the rays have no return", tally.points,
        100.0 * static_cast<double>(tally.rays - seen) / static_cast<double>(tally.rays)));
  }
  if (tally.second_returns > 0) {
    remarks.push_back(source.keeps_seconds
                          ? fmt::format("{} of the points are second returns, right behind the "
                                        "first of their ray",
                                        tally.second_returns)
                          : fmt::format("{} second returns left out; 'returns: all' makes them "
                                        "points too",
                                        tally.second_returns));
  }
  if (tally.cut > 0) {
    remarks.push_back(
        fmt::format("{} of {} scans cover less than a turn, the shortest {:.0f} % of it, as at the "
                    "begin and end of a log",
                    tally.cut, scans, 100 * tally.least_turn));
  }
  if (!source.remark.empty()) remarks.push_back(source.remark);
  return remarks;
}

std::string LidarSheet(const LidarPlan& plan, const ImportedFrames& frames) {
  std::string text = fmt::format("type: {}\nname: {}\n", plan.sensor.type, plan.sensor.name);
  if (!plan.sensor.link.empty()) text += MountingYaml(plan.sensor.link, plan.sensor.X_LS);
  text += frames.RateYaml();
  if (!plan.source.unit.empty()) text += fmt::format("unit: {}\n", YamlQuoted(plan.source.unit));
  return text + plan.source.model_yaml +
         fmt::format("imported_from: {}\n", YamlQuoted(plan.source.file.filename().string()));
}

/// Reads the scans, and writes them unless the import only checks.
class LidarImport {
 public:
  LidarImport(const LidarPlan& plan, ImportRun* run)
      : plan_(plan), run_(run), frames_(plan.folder, run) {}

  void Run() {
    DatasetWriter* const writer = run_->writer();
    if (writer != nullptr) {
      channel_ = writer->AddChannel({.path = plan_.folder,
                                     .type = std::string(kLidarChannel),
                                     .form = ChannelForm::kScans,
                                     .sensor_yaml = LidarSheet(plan_, frames_),
                                     .columns = {}});
    }
    ScanReading reading{.skips_bad = run_->options().skips_bad_rows,
                        .leave_out = [this](const InputError& fault) { frames_.LeaveOut(fault); },
                        .take = [this](UnitScan scan) { Take(std::move(scan)); }};
    plan_.source.read(&reading);
    ImportedChannel* told = frames_.Report(plan_.source.file, reading.pieces);
    told->remarks = RemarksOn(tally_, frames_.t_ns().size(), plan_.source);
    // sensor.yaml is written last, because it needs the scan rate.
    if (writer != nullptr) {
      WriteWholeFile(writer->PathFor(plan_.folder + "/sensor.yaml"), LidarSheet(plan_, frames_));
    }
  }

 private:
  void Take(UnitScan scan) {
    const auto t_ns = frames_.Take(scan.scan.t_ns, plan_.source.offset_s, scan.place, "scan");
    if (!t_ns) return;
    Count(scan, &tally_);
    if (run_->writer() == nullptr) return;
    scan.scan.t_ns = scan.scan.t_available_ns = *t_ns;
    run_->writer()->Write(channel_, std::move(scan.scan));
  }

  const LidarPlan& plan_;
  ImportRun* run_;
  ImportedFrames frames_;
  ChannelId channel_ = 0;
  ScanTally tally_;
};

}  // namespace

ImportJob ReadLidar(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  LidarPlan plan;
  plan.folder = ReadPath(config, "", mapping);
  plan.sensor = ReadSensorMount(config, std::string(kLidarChannel));
  plan.source = ReadLidarSource(config, top, mapping->unpacked);
  return [plan](ImportRun* run) { LidarImport(plan, run).Run(); };
}

}  // namespace tera
