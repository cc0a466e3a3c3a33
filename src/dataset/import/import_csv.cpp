#include "dataset/import/import_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>

#include "core/config/plain_name.h"
#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/format/recorded_inputs.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/foreign_file.h"
#include "dataset/import/import_run.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/pictures/camera_channel.h"
#include "dataset/import/scans/lidar_channel.h"

namespace tera {
namespace {

constexpr double kEpoch_s = 1e8;  ///< greater times, in s, count from an epoch

Mapping ReadMapping(const ConfigMap& top, const ImportOptions& options, UnpackedFiles* unpacked) {
  Mapping mapping{.options = options, .unpacked = unpacked};
  mapping.info.scenario_name = top.Text("name");
  mapping.info.simulated = top.Boolean("simulated", false);
  mapping.machine = top.Text("machine");
  RequirePlainName(top, "machine", mapping.machine);
  if (mapping.machine == "truth") {
    top.Fault("machine", "'truth' is reserved for a folder of every recording; choose another");
  }
  for (const char* shared : {"file", "time", "csv", "talker"})
    top.Has(shared);  // marks the key as known; each channel may override it
  mapping.starts_at_zero = top.Choice("zero", {"start", "as_written"}, "as_written") == "start";
  mapping.epoch = ReadEpoch(top, /*may_count_from_1970=*/true);
  top.Has("machine_model");  // marks the key as known; encoders read it when they need it
  if (const auto origin = top.OptionalMap("origin")) {
    mapping.info.origin_lat_deg = origin->Number("lat_deg", Between(-90, 90, "deg"));
    mapping.info.origin_lon_deg = origin->Number("lon_deg", Between(-180, 180, "deg"));
    mapping.info.origin_height_m = origin->Number("height_m", Any("m"));
  }
  for (const ConfigMap& item : top.List("imus")) {
    mapping.jobs.push_back(ReadImu(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("gyros")) {
    mapping.jobs.push_back(ReadGyro(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("gnss")) {
    if (!top.Has("origin")) item.Fault("", "need the mapping's origin for east, north and up");
    mapping.jobs.push_back(ReadGnss(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("encoders")) {
    mapping.jobs.push_back(ReadEncoder(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("tables")) {
    mapping.jobs.push_back(ReadTable(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("lidars")) {
    mapping.jobs.push_back(ReadLidar(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("cameras")) {
    mapping.jobs.push_back(ReadCamera(item, top, &mapping));
  }
  if (const auto pose = top.OptionalMap("pose")) {
    mapping.jobs.push_back(ReadPose(*pose, top, &mapping));
  }
  if (mapping.jobs.empty()) {
    top.Fault("",
              "imports nothing, need at least one of imus, gyros, gnss, encoders, tables, lidars, "
              "cameras "
              "and pose");
  }
  return mapping;
}

/// Time 0 of the recording, in the time of the files.
struct FoundZero {
  TimeNs zero_ns = 0;
  ClockScale clock = ClockScale::kUnknown;  ///< time scale common to all files
};

/// Earliest time of all imported rows; 0 if there are none.
FoundZero FirstOf(const Mapping& mapping, const ImportOptions& options) {
  // A dry run is necessary, because a row may be rejected when its channel is read.
  ImportRun run(options, nullptr, 0);
  for (const ImportJob& job : mapping.jobs) job(&run);
  const ClockScale clock = run.Clock();
  std::optional<TimeNs> first_ns;
  for (const ImportedChannel& channel : run.TakeReport().channels) {
    if (channel.rows == 0) continue;
    first_ns = std::min(first_ns.value_or(channel.first_ns), channel.first_ns);
  }
  return {first_ns.value_or(0), clock};
}

/// Epoch of the recording, from the mapping or else from the magnitude of the files' times.
std::optional<RecordingEpoch> EpochOf(const Mapping& mapping, const FoundZero& zero) {
  if (mapping.epoch) {
    return RecordingEpoch{mapping.epoch->since_1970_ns + zero.zero_ns, mapping.epoch->clock};
  }
  if (ToSeconds(zero.zero_ns) < kEpoch_s) return std::nullopt;
  return RecordingEpoch{zero.zero_ns, zero.clock};
}

/// Throws InputError if the mapping's epoch contradicts the times of the files, or if dataset.yaml
/// could not represent the epoch.
void RequireReadableEpoch(const ConfigMap& top, const Mapping& mapping, const FoundZero& zero,
                          const std::optional<RecordingEpoch>& epoch) {
  if (!epoch) return;
  const bool counts_from_1970 = ToSeconds(zero.zero_ns) >= kEpoch_s;
  const std::string key = mapping.epoch ? "epoch" : "zero";
  if (mapping.epoch && !top.Map("epoch").Has("since_1970_ns") && !counts_from_1970) {
    throw InputError(top.Map("epoch").Place("since_1970_ns"),
                     {FaultKind::kMissing,
                      "is missing: the files' times do not count from 1970; need the date of their "
                      "zero, since_1970_ns: \"1700000000000000000\""});
  }
  if (mapping.epoch && mapping.epoch->since_1970_ns > 0 && counts_from_1970) {
    throw InputError(
        top.Map("epoch").Place("since_1970_ns"),
        {FaultKind::kInconsistent, "contradicts times that already count from 1970; remove it"});
  }
  try {
    const Config written = Config::FromText(EpochYaml(*epoch), "epoch");
    ReadEpoch(written.root());
    written.Finish();
  } catch (const InputError&) {
    throw InputError(top.Place(key),
                     {FaultKind::kOutOfRange,
                      fmt::format("the recording would begin {:.6g} years after 1970, need 0 to "
                                  "130: check the unit and the offset of its time",
                                  ToSeconds(epoch->since_1970_ns) / (365.25 * 86400))});
  }
}

void RequireOwnZero(const std::filesystem::path& mapping, const ImportReport& report,
                    bool starts_at_zero) {
  for (const ImportedChannel& channel : report.channels) {
    if (channel.rows == 0 || std::abs(ToSeconds(channel.first_ns)) < kEpoch_s) continue;
    if (starts_at_zero) {
      throw InputError(
          mapping.string(),
          {FaultKind::kInconsistent,
           fmt::format(
               "times of {} begin {:.0f} s after those of the first channel: two clocks, or an "
               "epoch in one of them only? give one of them a 'time' with the offset in s",
               channel.path, ToSeconds(channel.first_ns))});
    }
    throw InputError(
        mapping.string(),
        {FaultKind::kMissing,
         fmt::format(
             "times of {} begin at {:.0f} s and seem to count from an epoch, but a recording "
             "begins near zero; add 'zero: start' to the mapping, or an offset to its time",
             channel.path, ToSeconds(channel.first_ns))});
  }
}

double DurationOf_s(const ImportReport& report) {
  TimeNs first_ns = std::numeric_limits<TimeNs>::max();
  TimeNs last_ns = std::numeric_limits<TimeNs>::min();
  for (const ImportedChannel& channel : report.channels) {
    if (channel.rows == 0) continue;
    first_ns = std::min(first_ns, channel.first_ns);
    last_ns = std::max(last_ns, channel.last_ns);
  }
  return last_ns > first_ns ? ToSeconds(last_ns - first_ns) : 0.0;
}

bool NamesAMachine(const std::filesystem::path& mapping) {
  std::ifstream stream(mapping);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("machine:")) return true;
  }
  return false;
}

/// Throws InputError if a log is given instead of a mapping, a frequent mistake.
void RequireNoLog(const std::filesystem::path& mapping) {
  const std::string ending = LowerCase(mapping.extension().string());
  const bool is_yaml = ending == ".yaml" || ending == ".yml" || ending == ".json";
  std::error_code ignored;
  if (is_yaml || !std::filesystem::exists(mapping, ignored)) return;
  const bool is_log = LooksLikeBag(mapping) || !TypeOfLog(mapping).empty();
  constexpr const char* kNeed = "a mapping, a YAML file that describes the columns of a log";
  if (!is_log) RefuseForeignFile(mapping, kNeed);
  if (!is_log && NamesAMachine(mapping)) return;
  throw InputError(mapping.string(), {FaultKind::kUnsupported,
                                      fmt::format("is not a mapping; need {}: `tera import "
                                                  "--suggest {} > mapping.yaml` writes a first one",
                                                  kNeed, mapping.string())});
}

}  // namespace

ImportReport ImportCsv(const std::filesystem::path& mapping_file, const std::filesystem::path& out,
                       const ImportOptions& options) {
  RequireNoLog(mapping_file);
  const Config config = Config::FromFile(mapping_file, options.overrides);
  UnpackedFiles unpacked;
  Mapping mapping = ReadMapping(config.root(), options, &unpacked);
  config.Finish();
  const FoundZero zero = mapping.starts_at_zero ? FirstOf(mapping, options) : FoundZero{};
  mapping.info.epoch = EpochOf(mapping, zero);
  RequireReadableEpoch(config.root(), mapping, zero, mapping.info.epoch);
  const auto run_jobs = [&](DatasetWriter* writer) {
    ImportRun run(options, writer, zero.zero_ns);
    for (const ImportJob& job : mapping.jobs) job(&run);
    ImportReport report = run.TakeReport();
    report.zero_ns = zero.zero_ns;
    report.epoch = mapping.info.epoch;
    RequireOwnZero(mapping_file, report, mapping.starts_at_zero);
    return report;
  };
  if (options.checks_only) return run_jobs(nullptr);
  mapping.info.resolved_scenario_yaml = config.ResolvedYaml();
  mapping.info.inputs = DigestsOf(config.root().Inputs());
  DatasetWriter writer(out, mapping.info,
                       {.kind = "import", .remedy = "delete it and import it again"});
  try {
    const ImportReport report = run_jobs(&writer);
    writer.SetDuration(DurationOf_s(report));
    writer.Finish();
    return report;
  } catch (...) {
    writer.Discard();
    throw;
  }
}

}  // namespace tera
