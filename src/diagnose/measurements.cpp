#include "diagnose/measurements.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error.h"
#include "diagnose/input_checks.h"
#include "diagnose/sensors/offset_receivers.h"
#include "diagnose/sensors/reversed_axes.h"

namespace tera {
namespace {

constexpr double kRounding_s = 0.05;        ///< rounding of lengths in messages
constexpr double kShortestPeriod_s = 1e-4;  ///< no encoder or inertial unit samples faster

std::vector<NamedEncoders> EncodersOf(const Recording& recording, const std::string& machine) {
  std::vector<NamedEncoders> encoders;
  for (const std::string& channel : recording.ChannelsOf(kEncoderChannel)) {
    if (channel.starts_with(machine + "/")) {
      encoders.push_back({channel, recording.LoadEncoder(channel)});
    }
  }
  return encoders;
}

/// Removes the samples outside of two times.
template <typename Sample>
void Trim(TimeNs from_ns, TimeNs to_ns, std::vector<Sample>* samples) {
  std::erase_if(*samples, [&](const Sample& s) { return s.t_ns < from_ns || s.t_ns > to_ns; });
}

void Trim(TimeNs from_ns, TimeNs to_ns, TableRecording* table) {
  const auto first = std::lower_bound(table->t_ns.begin(), table->t_ns.end(), from_ns);
  const auto end = std::upper_bound(first, table->t_ns.end(), to_ns);
  const auto rows = table->rows.begin();
  table->rows = {rows + (first - table->t_ns.begin()), rows + (end - table->t_ns.begin())};
  table->t_ns = {first, end};
}

/// First and last time of measurement. Receivers count only without other measurements, since their
/// clocks are not the machine's.
std::pair<TimeNs, TimeNs> SpanOf(const Measurements& measured) {
  TimeNs start_ns = std::numeric_limits<TimeNs>::max(), end_ns = 0;
  const auto add = [&](const auto& samples) {
    if (samples.empty()) return;
    start_ns = std::min(start_ns, samples.front().t_ns);
    end_ns = std::max(end_ns, samples.back().t_ns);
  };
  for (const NamedEncoders& named : measured.encoders) add(named.recording.samples);
  for (const auto& samples : measured.imus) add(samples);
  if (start_ns < std::numeric_limits<TimeNs>::max()) return {start_ns, end_ns};
  for (const auto& samples : measured.gnss) add(samples);
  return {start_ns, end_ns};
}

/// Hint at a wrong unit of time if samples are denser than any sensor's.
std::string UnitOfTimeText(const Measurements& measured, double length_s) {
  std::size_t most = 0;
  for (const auto& named : measured.encoders) most = std::max(most, named.recording.samples.size());
  for (const auto& samples : measured.imus) most = std::max(most, samples.size());
  return most > 1 && length_s / static_cast<double>(most - 1) < kShortestPeriod_s
             ? "; t_ns counts nanoseconds: are these microseconds or milliseconds?"
             : "";
}

/// Throws if the diagnosed part is too short.
void RequireLongEnough(const Measurements& measured, const MeasurementOptions& options) {
  const double length_s = ToSeconds(SpanOf(measured).second - measured.start_ns);
  const double left_s = std::min(options.to_s, length_s) - options.from_s;
  if (left_s >= kShortestRecording_s - kRounding_s) return;
  const bool is_whole = options.from_s == 0 && options.to_s >= length_s;
  throw InputError(measured.recording,
                   fmt::format("{:.1f} s were measured{}; need {:g} s at least{}", length_s,
                               is_whole ? ""
                                        : fmt::format(", of which --from and --to leave {:.1f} s",
                                                      std::max(0.0, left_s)),
                               kShortestRecording_s, UnitOfTimeText(measured, length_s)));
}

void CheckMeasurements(const DiagnosisInput& input, const Recording& recording,
                       const Measurements& measured) {
  const RecordedPlace place{recording.directory().string(), input.machine};
  CheckLevers(place, input.commands, *input.model);
  CheckClocks(place, input.commands, measured.encoders, measured.imus, measured.gnss,
              measured.poses);
  CheckEncoders(place, input.commands, measured.encoders, *input.model);
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    const std::string channel = input.machine + "/" + input.sensors[s].name;
    CheckImu(place, channel, measured.imus[s]);
    CheckGnss(place, channel, measured.gnss[s], measured.poses);
  }
}

/// Names of recorded and wanted channels: "the recording has gnss (gnss), the scenario imu_boom".
std::string ChannelsText(const DiagnosisInput& input, const Recording& recording) {
  std::vector<std::string> recorded, wanted;
  const std::string prefix = input.machine + "/";
  for (const ChannelDescription& channel : recording.channels()) {
    if (!channel.path.starts_with(prefix)) continue;
    recorded.push_back(fmt::format("{} ({})", channel.path.substr(prefix.size()), channel.type));
  }
  for (const SensorDescription& sensor : input.sensors) wanted.push_back(sensor.name);
  const auto list = [](const std::vector<std::string>& names) {
    return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
  };
  return fmt::format("the recording has {}, the scenario {}", list(recorded), list(wanted));
}

}  // namespace

Measurements MeasurementsOf(const DiagnosisInput& input, const Recording& recording,
                            const MeasurementOptions& options) {
  Measurements measured;
  measured.recording = recording.directory().string();
  measured.encoders = EncodersOf(recording, input.machine);
  const std::size_t all = measured.encoders.size();
  std::erase_if(measured.encoders,
                [](const NamedEncoders& named) { return named.recording.samples.empty(); });
  const std::string poses = "truth/" + input.machine + "/pose.csv";
  if (recording.Has(poses)) measured.poses = recording.LoadPose(poses).poses;
  measured.poses_were_measured = !measured.poses.empty() && !recording.info().simulated;
  const std::string efforts = input.machine + "/efforts.csv";
  if (recording.Has(efforts)) measured.efforts = recording.LoadTable(efforts);
  bool any = !measured.encoders.empty();
  for (const SensorDescription& sensor : input.sensors) {
    const std::string channel = input.machine + "/" + sensor.name;
    const bool is_imu = std::holds_alternative<ImuModel>(sensor.model) && recording.Has(channel);
    measured.imus.push_back(is_imu ? recording.LoadImu(channel) : std::vector<ImuSample>{});
    const bool is_gnss = std::holds_alternative<GnssModel>(sensor.model) && recording.Has(channel);
    measured.gnss.push_back(is_gnss ? recording.LoadGnss(channel) : std::vector<GnssSample>{});
    any = any || !measured.imus.back().empty() || !measured.gnss.back().empty();
  }
  if (!any && !options.needs_any) return measured;
  if (!any) {
    throw InputError(
        recording.directory().string(),
        fmt::format("{} of {}, and no inertial unit or receiver that the scenario has; need "
                    "something measured to compare: {}",
                    all > 0 ? "no sample in the encoder channels" : "no encoder channel",
                    input.machine, ChannelsText(input, recording)));
  }
  CheckMeasurements(input, recording, measured);
  measured.reversed = ReversedAxesOf(input, measured);
  CountForwards(measured.reversed, &measured);
  measured.offset_receivers = OffsetReceiversOf(input, measured);
  StampAnew(measured.offset_receivers, &measured);
  measured.start_ns = SpanOf(measured).first;
  if (options.needs_any) RequireLongEnough(measured, options);
  const TimeNs from_ns = measured.start_ns + FromSeconds(options.from_s);
  const TimeNs to_ns = measured.start_ns + FromSeconds(options.to_s);
  for (NamedEncoders& named : measured.encoders) Trim(from_ns, to_ns, &named.recording.samples);
  for (auto& samples : measured.imus) Trim(from_ns, to_ns, &samples);
  for (auto& samples : measured.gnss) Trim(from_ns, to_ns, &samples);
  Trim(from_ns, to_ns, &measured.efforts);
  return measured;
}

const std::vector<TruthPose>& BasePoses(const Measurements& measured) {
  return measured.poses.empty() ? measured.estimated_poses : measured.poses;
}

}  // namespace tera
