#include "dataset/compare/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/units.h"
#include "dataset/compare/receiver_tracks.h"
#include "dataset/compare/time_alignment.h"
#include "dataset/compare/track_doubts.h"
#include "dataset/format/recording.h"
#include "dataset/format/series_tables.h"
#include "dataset/overview/gnuplot.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kTellsHeading_m = 1;  ///< a shorter path does not determine a heading

/// One column over time.
struct Signal {
  std::string column;
  std::vector<TimeNs> t_ns;
  std::vector<double> value;
};

std::string PosePath(const std::string& machine) { return "truth/" + machine + "/pose.csv"; }

Trajectory LoadTrajectory(const RecordedMachine& machine) {
  Trajectory track;
  if (!machine.recording->Has(PosePath(machine.name))) return track;
  for (const TruthPose& pose : machine.recording->LoadPose(PosePath(machine.name)).poses) {
    track.push_back({pose.t_ns + machine.shift_ns, pose.X_WB});
  }
  return track;
}

std::vector<Signal> SignalsOf(const Recording& recording, const std::string& path,
                              TimeNs shift_ns) {
  const TableRecording table = recording.TypeOf(path) == kTableChannel ? recording.LoadTable(path)
                                                                       : recording.LoadRows(path);
  std::vector<Signal> signals;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    Signal signal{table.columns[c], table.t_ns, {}};
    for (TimeNs& t_ns : signal.t_ns) t_ns += shift_ns;
    for (const std::vector<double>& row : table.rows) signal.value.push_back(row[c]);
    signals.push_back(std::move(signal));
  }
  return signals;
}

/// Difference b - a at the times of a that lie within b, with b interpolated.
ChannelDifference Difference(const std::string& channel, const Signal& a, const Signal& b) {
  ChannelDifference d{channel, a.column};
  double sum = 0, square_sum = 0;
  for (std::size_t i = 0; i < a.t_ns.size(); ++i) {
    const auto after = std::lower_bound(b.t_ns.begin(), b.t_ns.end(), a.t_ns[i]);
    if (after == b.t_ns.end() || (after == b.t_ns.begin() && *after != a.t_ns[i])) continue;
    const auto k = static_cast<std::size_t>(after - b.t_ns.begin());
    double value = b.value[k];
    if (b.t_ns[k] != a.t_ns[i]) {
      const double s = static_cast<double>(a.t_ns[i] - b.t_ns[k - 1]) /
                       static_cast<double>(b.t_ns[k] - b.t_ns[k - 1]);
      value = (1.0 - s) * b.value[k - 1] + s * b.value[k];
    }
    sum += value - a.value[i];
    square_sum += (value - a.value[i]) * (value - a.value[i]);
    ++d.count;
  }
  if (d.count > 0) {
    d.mean = sum / static_cast<double>(d.count);
    d.rmse = std::sqrt(square_sum / static_cast<double>(d.count));
  }
  return d;
}

/// Appends the differences of all time series that both machines have.
void CompareSeries(const Recording& a, const Recording& b, TimeNs shift_ns,
                   MachineComparison* machine) {
  const std::string prefix = machine->name_a + "/";
  std::vector<std::string> series = a.SeriesChannels();
  for (const std::string& table : SeriesTables(a)) series.push_back(table);
  for (const std::string& folder : series) {
    if (!folder.starts_with(prefix)) continue;
    const std::string channel = folder.substr(prefix.size());
    const std::string other = machine->name_b + "/" + channel;
    if (!b.Has(other) || b.TypeOf(other) != a.TypeOf(folder)) continue;
    // A sensor's name may contain a dot; only a table has a file name extension.
    const bool is_table = a.TypeOf(folder) == kTableChannel;
    const std::string name = is_table ? fs::path(channel).replace_extension().string() : channel;
    const auto signals_b = SignalsOf(b, other, shift_ns);
    for (const Signal& signal : SignalsOf(a, folder, 0)) {
      const auto match = std::find_if(signals_b.begin(), signals_b.end(),
                                      [&](const Signal& s) { return s.column == signal.column; });
      if (match == signals_b.end()) continue;
      const ChannelDifference difference = Difference(name, signal, *match);
      if (difference.count > 0) machine->channels.push_back(difference);
    }
  }
}

TrackComparison CompareTracks(const std::string& of, TrackComparison::Rotation rotation,
                              Trajectory a, Trajectory b, TimeNs max_gap_ns) {
  TrackComparison track{of, rotation, std::move(a), std::move(b), {}, {}, {}, {}};
  TrajectoryErrorOptions options{.max_gap_ns = max_gap_ns};
  track.unaligned = EvaluateTrajectory(track.a, track.b, options);
  options.alignment = Alignment::kSe2;
  track.aligned_se2 = EvaluateTrajectory(track.a, track.b, options);
  options.alignment = Alignment::kSe3;
  track.aligned_se3 = EvaluateTrajectory(track.a, track.b, options);
  track.doubts = TrackDoubts(track.a, track.b, max_gap_ns);
  return track;
}

void CompareReceivers(const RecordedMachine& a, const RecordedMachine& b,
                      MachineComparison* machine) {
  ReceiverTracks found = TracksOfReceivers(a, b);
  for (AntennaTracks& one : found.antennas) {
    const bool has_heading = !one.heading.empty();
    machine->tracks.push_back(CompareTracks(
        has_heading ? one.antenna + ", heading from " + one.heading : one.antenna,
        has_heading ? TrackComparison::Rotation::kHeading : TrackComparison::Rotation::kNone,
        std::move(one.a), std::move(one.b), one.max_gap_ns));
  }
  machine->remarks = std::move(found.remarks);
}

MachineComparison CompareMachine(const RecordedMachine& a, const RecordedMachine& b,
                                 std::size_t every) {
  MachineComparison machine{.name_a = a.name, .name_b = b.name};
  Trajectory poses_a = LoadTrajectory(a), poses_b = LoadTrajectory(b);
  if (!poses_a.empty() && !poses_b.empty()) {
    machine.tracks.push_back(CompareTracks("poses", TrackComparison::Rotation::kAll,
                                           std::move(poses_a), std::move(poses_b), kNsPerSecond));
  } else {
    CompareReceivers(a, b, &machine);
  }
  CompareSeries(*a.recording, *b.recording, b.shift_ns, &machine);
  machine.scans = CompareScans(a, b, every);
  machine.pictures = ComparePictures(a, b, every);
  return machine;
}

/// Text such as "imu (imu), gnss_left (gnss)".
std::string ChannelsText(const Recording& recording, const std::string& machine) {
  std::vector<std::string> names;
  for (const ChannelDescription& channel : recording.channels()) {
    const bool is_of_it =
        channel.path.starts_with(machine + "/") || channel.path == PosePath(machine);
    if (is_of_it) names.push_back(fmt::format("{} ({})", channel.path, channel.type));
  }
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

void RequireSomething(const Recording& a, const Recording& b, const Comparison& comparison) {
  const auto has_something = [](const MachineComparison& machine) {
    const auto has_pairs = [](const auto& one) { return !one.sensor.pairs.empty(); };
    return !machine.tracks.empty() || !machine.channels.empty() ||
           std::any_of(machine.scans.begin(), machine.scans.end(), has_pairs) ||
           std::any_of(machine.pictures.begin(), machine.pictures.end(), has_pairs);
  };
  const auto& machines = comparison.machines;
  if (std::any_of(machines.begin(), machines.end(), has_something)) return;
  std::string found;
  for (const MachineComparison& machine : machines) {
    fmt::format_to(std::back_inserter(found), "{} has {}, and {} has {}; ", a.directory().string(),
                   ChannelsText(a, machine.name_a), b.directory().string(),
                   ChannelsText(b, machine.name_b));
    for (const std::string& remark : machine.remarks) found += remark + "; ";
  }
  throw InputError(
      b.directory().string(),
      {FaultKind::kMissing,
       fmt::format(
           "nothing to compare: {}need poses in both recordings (truth/<machine>/pose.csv), a "
           "receiver with fixes in both, or a channel of the same name and type with common times",
           found)});
}

std::vector<std::pair<std::string, std::string>> MatchMachines(const Recording& a,
                                                               const Recording& b) {
  const auto in_a = a.Machines(), in_b = b.Machines();
  std::vector<std::pair<std::string, std::string>> matches;
  for (const std::string& name : in_a) {
    if (std::find(in_b.begin(), in_b.end(), name) != in_b.end()) matches.emplace_back(name, name);
  }
  if (matches.empty() && in_a.size() == 1 && in_b.size() == 1) {
    matches.emplace_back(in_a[0], in_b[0]);
  }
  if (matches.empty()) {
    throw InputError(
        b.directory().string(),
        {FaultKind::kNoSuchName,
         fmt::format(
             "has the machines [{}] and {} has [{}]; need one common name, or one machine in each",
             fmt::join(in_b, ", "), a.directory().string(), fmt::join(in_a, ", "))});
  }
  return matches;
}

void AppendErrors(std::string* text, const char* title, const TrajectoryError& e,
                  bool tells_rotation) {
  const ErrorStatistics& t = e.ape_translation_m;
  const ErrorStatistics& r = e.ape_rotation_rad;
  const auto out = std::back_inserter(*text);
  fmt::format_to(out, "  {:<22}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}", title, t.rmse, t.mean, t.median,
                 t.max);
  if (tells_rotation) {
    fmt::format_to(out, "  {:>9.2f}{:>9.2f}{:>9.2f}", r.rmse / kDeg, r.mean / kDeg, r.max / kDeg);
  }
  text->push_back('\n');
}

void AppendTrack(std::string* text, const TrackComparison& track) {
  const TrajectoryError& e = track.unaligned;
  const bool is_turned = track.rotation != TrackComparison::Rotation::kNone;
  const auto out = std::back_inserter(*text);
  if (track.rotation != TrackComparison::Rotation::kAll) {
    fmt::format_to(out, "  antenna {}\n", track.of);
  }
  fmt::format_to(out, "  {:<22}{:>9}{:>9}{:>9}{:>9}", "", "rmse m", "mean m", "median m", "max m");
  if (is_turned) fmt::format_to(out, "  {:>9}{:>9}{:>9}", "rmse deg", "mean deg", "max deg");
  text->push_back('\n');
  AppendErrors(text, "APE, not aligned", track.unaligned, is_turned);
  AppendErrors(text, "APE, SE(2) aligned", track.aligned_se2, is_turned);
  // After SE(3) alignment, the rotation error is meaningless if only the heading is known.
  AppendErrors(text, "APE, SE(3) aligned", track.aligned_se3,
               track.rotation == TrackComparison::Rotation::kAll);
  TrajectoryError relative;
  relative.ape_translation_m = e.rpe_translation_m;
  relative.ape_rotation_rad = e.rpe_rotation_rad;
  AppendErrors(text, "RPE over 1 s", relative, is_turned);
  fmt::format_to(out,
                 "  {} common times; path length {:.2f} m and {:.2f} m; final drift {:.3f} m "
                 "({:.1f} % of the path){}\n",
                 e.ape.size(), e.path_length_a_m, e.path_length_b_m, e.final_drift_m,
                 e.path_length_a_m > 0 ? 100.0 * e.final_drift_m / e.path_length_a_m : 0.0,
                 is_turned ? fmt::format(", {:.2f} deg", e.final_drift_rad / kDeg) : "");
  if (is_turned && std::min(e.path_length_a_m, e.path_length_b_m) < kTellsHeading_m) {
    text->append("  a path below 1 m does not determine the heading: ignore aligned rotations\n");
  }
  for (const std::string& doubt : track.doubts) fmt::format_to(out, "  hint: {}\n", doubt);
}

Curve PathCurve(const std::string& title, const Trajectory& track, const Pose& X_WV) {
  Curve curve{title, {}, {}};
  for (const TimedPose& pose : track) {
    const Vec3 p = X_WV * pose.X_WB.translation();
    curve.x.push_back(p.x());
    curve.y.push_back(p.y());
  }
  return curve;
}

Curve ErrorCurve(const std::string& title, const TrajectoryError& error,
                 double PoseErrorSample::*member, double unit) {
  Curve curve{title, {}, {}};
  for (const PoseErrorSample& sample : error.ape) {
    curve.x.push_back(ToSeconds(sample.t_ns));
    curve.y.push_back(sample.*member / unit);
  }
  return curve;
}

/// Adds two charts of a track: its path, and its errors over time.
void AddCharts(const Comparison& comparison, const std::string& name, const TrackComparison& track,
               std::vector<Chart>* charts) {
  charts->push_back({name + ": from above, SE(2) aligned",
                     "x in m",
                     "y in m",
                     true,
                     {PathCurve(comparison.name_a, track.a, Pose::Identity()),
                      PathCurve(comparison.name_b, track.b, track.aligned_se2.X_WV)}});
  const auto errors = [&](double PoseErrorSample::*member, double unit, bool in_space) {
    std::vector<Curve> curves = {ErrorCurve("not aligned", track.unaligned, member, unit),
                                 ErrorCurve("SE(2)", track.aligned_se2, member, unit)};
    if (in_space) curves.push_back(ErrorCurve("SE(3)", track.aligned_se3, member, unit));
    return curves;
  };
  charts->push_back({"APE, translation", "time in s", "m", false,
                     errors(&PoseErrorSample::translation_m, 1.0, true)});
  if (track.rotation == TrackComparison::Rotation::kNone) return;
  const bool is_all = track.rotation == TrackComparison::Rotation::kAll;
  charts->push_back({is_all ? "APE, rotation" : "heading error", "time in s", "deg", false,
                     errors(&PoseErrorSample::rotation_rad, kDeg, is_all)});
}

/// Name with folder and scenario, because runs of one scenario differ only in the folder.
std::string NameOf(const Recording& recording) {
  return fmt::format("{} ({})", recording.directory().filename().string(),
                     recording.info().scenario_name);
}

}  // namespace

Comparison Compare(const std::filesystem::path& a, const std::filesystem::path& b,
                   std::size_t every) {
  const Recording recording_a(a), recording_b(b);
  const TimeAlignment times = AlignTimes(recording_a, recording_b);
  Comparison comparison{NameOf(recording_a), NameOf(recording_b), times.told, {}};
  for (const auto& [name_a, name_b] : MatchMachines(recording_a, recording_b)) {
    comparison.machines.push_back(
        CompareMachine({&recording_a, name_a, 0}, {&recording_b, name_b, times.shift_ns}, every));
  }
  RequireSomething(recording_a, recording_b, comparison);
  return comparison;
}

std::string ComparisonTable(const Comparison& comparison) {
  std::string text =
      fmt::format("reference: {}\ncompared:  {}\n", comparison.name_a, comparison.name_b);
  const auto out = std::back_inserter(text);
  if (!comparison.times.empty()) fmt::format_to(out, "times:     {}\n", comparison.times);
  for (const MachineComparison& machine : comparison.machines) {
    fmt::format_to(out, "\n{}{}\n", machine.name_a,
                   machine.name_a == machine.name_b ? "" : " and " + machine.name_b);
    for (const TrackComparison& track : machine.tracks) AppendTrack(&text, track);
    for (const std::string& remark : machine.remarks) fmt::format_to(out, "  {}\n", remark);
    if (!machine.channels.empty()) {
      fmt::format_to(out, "  {:<40}{:>12}{:>12}{:>9}\n", "channel, in its own unit", "rmse", "mean",
                     "samples");
    }
    for (const ChannelDifference& d : machine.channels) {
      fmt::format_to(out, "  {:<40}{:>12.5g}{:>12.5g}{:>9}\n", d.channel + " " + d.column, d.rmse,
                     d.mean, d.count);
    }
    for (const ScanComparison& scans : machine.scans) text += ScanTable(scans);
    for (const PictureComparison& pictures : machine.pictures) text += PictureTable(pictures);
  }
  return text;
}

void PlotComparison(const Comparison& comparison, const std::filesystem::path& png) {
  constexpr int kColumns = 3, kWidth_px = 1500, kRowHeight_px = 500;
  std::vector<Chart> charts;
  for (const MachineComparison& m : comparison.machines) {
    for (const TrackComparison& track : m.tracks) {
      const bool is_poses = track.rotation == TrackComparison::Rotation::kAll;
      AddCharts(comparison, is_poses ? m.name_a : m.name_a + ", " + track.of, track, &charts);
    }
  }
  if (charts.empty()) {
    throw InputError(
        png.string(),
        {FaultKind::kMissing,
         "nothing to plot: the recordings share no poses and no receivers of one machine"});
  }
  const int rows = (static_cast<int>(charts.size()) + kColumns - 1) / kColumns;
  DrawCharts(charts, kColumns, kWidth_px, rows * kRowHeight_px, png);
}

}  // namespace tera
