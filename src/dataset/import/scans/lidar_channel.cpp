#include "dataset/import/scans/lidar_channel.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/quantile.h"
#include "core/types/mounting.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/channel.h"
#include "dataset/import/scans/lidar_source.h"

namespace tera {
namespace {

constexpr double kWholeTurn = 0.95;  ///< least share of a turn of a whole scan; less counts as cut
                                     ///< off

/// One lidar of a mapping.
struct LidarPlan {
  std::string folder;
  ImportedSensor sensor;
  LidarSource source;
};

/// Counts of the imported scans.
struct ScanTally {
  std::vector<TimeNs> t_ns;
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

std::vector<std::string> RemarksOn(const ScanTally& tally, const LidarSource& source) {
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
        fmt::format("{} of {} scans hold less than a turn, the least {:.0f} % of it, "
                    "as where a log begins and ends",
                    tally.cut, tally.t_ns.size(), 100 * tally.least_turn));
  }
  if (!source.remark.empty()) remarks.push_back(source.remark);
  return remarks;
}

std::string LidarSheet(const LidarPlan& plan, const std::vector<TimeNs>& t_ns) {
  std::string text = fmt::format("type: {}\nname: {}\n", plan.sensor.type, plan.sensor.name);
  if (!plan.sensor.link.empty()) text += MountingYaml(plan.sensor.link, plan.sensor.X_LS);
  std::vector<TimeNs> intervals_ns;
  for (std::size_t k = 1; k < t_ns.size(); ++k) intervals_ns.push_back(t_ns[k] - t_ns[k - 1]);
  if (!intervals_ns.empty()) {
    text += fmt::format("rate_hz: {:.6g}\n", 1 / ToSeconds(Median(std::move(intervals_ns))));
  }
  if (!plan.source.unit.empty()) text += fmt::format("unit: {}\n", YamlQuoted(plan.source.unit));
  return text + plan.source.model_yaml +
         fmt::format("imported_from: {}\n", YamlQuoted(plan.source.file.filename().string()));
}

/// Reads the scans, and writes them where there is a writer.
class LidarImport {
 public:
  LidarImport(const LidarPlan& plan, ImportRun* run) : plan_(plan), run_(run) {}

  void Run() {
    DatasetWriter* const writer = run_->writer();
    if (writer != nullptr) {
      channel_ = writer->AddChannel({.path = plan_.folder,
                                     .type = std::string(kLidarChannel),
                                     .form = ChannelForm::kScans,
                                     .sensor_yaml = LidarSheet(plan_, {}),
                                     .columns = {}});
    }
    ScanReading reading{.skips_bad = run_->options().skips_bad_rows,
                        .leave_out = [this](const InputError& fault) { LeaveOutFault(fault); },
                        .take = [this](UnitScan scan) { Take(std::move(scan)); }};
    plan_.source.read(&reading);
    if (left_out_.count > reading.pieces / 2) {
      throw InputError(plan_.folder,
                       {FaultKind::kMalformed,
                        fmt::format("{} of {} packets, messages or scans cannot be read, more than "
                                    "--skip-bad-rows may leave out (half); the first: {}",
                                    left_out_.count, reading.pieces, left_out_.first)});
    }
    ImportedChannel* told = run_->AddFrames(plan_.folder, plan_.source.file.filename().string(),
                                            tally_.t_ns, left_out_);
    told->remarks = RemarksOn(tally_, plan_.source);
    // The rate is known only after all scans.
    if (writer != nullptr) {
      WriteWholeFile(writer->PathFor(plan_.folder + "/sensor.yaml"),
                     LidarSheet(plan_, tally_.t_ns));
    }
  }

 private:
  void LeaveOutFault(const InputError& fault) {
    if (!run_->options().skips_bad_rows) throw fault;
    left_out_.Add(fault.what());
  }

  void Take(UnitScan scan) {
    const TimeNs t_ns = scan.scan.t_ns + FromSeconds(plan_.source.offset_s) - run_->zero_ns();
    if (!tally_.t_ns.empty() && t_ns <= tally_.t_ns.back()) {
      LeaveOutFault(InputError(
          scan.place,
          {FaultKind::kInconsistent,
           fmt::format("its scan is at {:.6f} s, the one before at {:.6f} s; need a later time, as "
                       "where a clock was set or a log was joined wrongly; leave such out by "
                       "--skip-bad-rows, or take another clock by time: {{column: ...}}",
                       ToSeconds(t_ns), ToSeconds(tally_.t_ns.back()))}));
      return;
    }
    tally_.t_ns.push_back(t_ns);
    Count(scan, &tally_);
    if (run_->writer() == nullptr) return;
    scan.scan.t_ns = scan.scan.t_available_ns = t_ns;
    run_->writer()->Write(channel_, std::move(scan.scan));
  }

  const LidarPlan& plan_;
  ImportRun* run_;
  ChannelId channel_ = 0;
  ScanTally tally_;
  LeftOutRows left_out_;
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
