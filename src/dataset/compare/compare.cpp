#include "dataset/compare/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "core/error.h"
#include "core/units.h"
#include "dataset/format/recording.h"
#include "dataset/format/series_tables.h"
#include "dataset/overview/gnuplot.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kTellsHeading_m = 1;  ///< of path

/// One column over time.
struct Signal {
  std::string column;
  std::vector<TimeNs> t_ns;
  std::vector<double> value;
};

std::string PosePath(const std::string& machine) { return "truth/" + machine + "/pose.csv"; }

Trajectory LoadTrajectory(const Recording& recording, const std::string& machine) {
  Trajectory track;
  for (const TruthPose& pose : recording.LoadPose(PosePath(machine)).poses) {
    track.push_back({pose.t_ns, pose.X_WB});
  }
  return track;
}

std::vector<Signal> SignalsOf(const Recording& recording, const std::string& path) {
  const TableRecording table = recording.TypeOf(path) == kTableChannel ? recording.LoadTable(path)
                                                                       : recording.LoadRows(path);
  std::vector<Signal> signals;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    Signal signal{table.columns[c], table.t_ns, {}};
    for (const std::vector<double>& row : table.rows) signal.value.push_back(row[c]);
    signals.push_back(std::move(signal));
  }
  return signals;
}

/// b minus a at the times of a that lie within b, b interpolated.
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

/// Appends the differences of the series of numbers that both machines have.
void CompareSeries(const Recording& a, const Recording& b, MachineComparison* machine) {
  const std::string prefix = machine->name_a + "/";
  std::vector<std::string> series = a.SeriesChannels();
  for (const std::string& table : SeriesTables(a)) series.push_back(table);
  for (const std::string& folder : series) {
    if (!folder.starts_with(prefix)) continue;
    const std::string channel = folder.substr(prefix.size());
    const std::string other = machine->name_b + "/" + channel;
    if (!b.Has(other) || b.TypeOf(other) != a.TypeOf(folder)) continue;
    // Of a sensor, whose name a stranger may have chosen, a dot is part of it.
    const bool is_table = a.TypeOf(folder) == kTableChannel;
    const std::string name = is_table ? fs::path(channel).replace_extension().string() : channel;
    const auto signals_b = SignalsOf(b, other);
    for (const Signal& signal : SignalsOf(a, folder)) {
      const auto match = std::find_if(signals_b.begin(), signals_b.end(),
                                      [&](const Signal& s) { return s.column == signal.column; });
      if (match == signals_b.end()) continue;
      const ChannelDifference difference = Difference(name, signal, *match);
      if (difference.count > 0) machine->channels.push_back(difference);
    }
  }
}

MachineComparison CompareMachine(const Recording& a, const Recording& b, const std::string& name_a,
                                 const std::string& name_b) {
  MachineComparison machine;
  machine.name_a = name_a;
  machine.name_b = name_b;
  if (a.Has(PosePath(name_a)) && b.Has(PosePath(name_b))) {
    machine.a = LoadTrajectory(a, name_a);
    machine.b = LoadTrajectory(b, name_b);
  }
  if (machine.HasTrajectories()) {
    TrajectoryErrorOptions options;
    machine.unaligned = EvaluateTrajectory(machine.a, machine.b, options);
    options.alignment = Alignment::kSe2;
    machine.aligned_se2 = EvaluateTrajectory(machine.a, machine.b, options);
    options.alignment = Alignment::kSe3;
    machine.aligned_se3 = EvaluateTrajectory(machine.a, machine.b, options);
  }
  CompareSeries(a, b, &machine);
  return machine;
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
        fmt::format("{} has the machines [{}] and {} has [{}]; need one name in common, or one "
                    "machine in each",
                    a.directory().string(), fmt::join(in_a, ", "), b.directory().string(),
                    fmt::join(in_b, ", ")));
  }
  return matches;
}

void AppendErrors(std::string* text, const char* title, const TrajectoryError& e) {
  const ErrorStatistics& t = e.ape_translation_m;
  const ErrorStatistics& r = e.ape_rotation_rad;
  fmt::format_to(std::back_inserter(*text),
                 "  {:<22}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}  {:>9.2f}{:>9.2f}{:>9.2f}\n", title,
                 t.rmse, t.mean, t.median, t.max, r.rmse / kDeg, r.mean / kDeg, r.max / kDeg);
}

void AppendTrajectory(std::string* text, const MachineComparison& m) {
  const TrajectoryError& e = m.unaligned;
  const auto out = std::back_inserter(*text);
  fmt::format_to(out, "  {:<22}{:>9}{:>9}{:>9}{:>9}  {:>9}{:>9}{:>9}\n", "", "rmse m", "mean m",
                 "median m", "max m", "rmse deg", "mean deg", "max deg");
  AppendErrors(text, "APE, not aligned", m.unaligned);
  AppendErrors(text, "APE, SE(2) aligned", m.aligned_se2);
  AppendErrors(text, "APE, SE(3) aligned", m.aligned_se3);
  TrajectoryError relative;
  relative.ape_translation_m = e.rpe_translation_m;
  relative.ape_rotation_rad = e.rpe_rotation_rad;
  AppendErrors(text, "RPE over 1 s", relative);
  fmt::format_to(out,
                 "  {} common times; path length {:.2f} m and {:.2f} m; final drift {:.3f} m "
                 "({:.1f} % of the path), {:.2f} deg\n",
                 e.ape.size(), e.path_length_a_m, e.path_length_b_m, e.final_drift_m,
                 e.path_length_a_m > 0 ? 100.0 * e.final_drift_m / e.path_length_a_m : 0.0,
                 e.final_drift_rad / kDeg);
  if (std::min(e.path_length_a_m, e.path_length_b_m) < kTellsHeading_m) {
    text->append("  a path of less than 1 m does not tell its heading: ignore aligned rotations\n");
  }
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

/// Folder and scenario: two runs of one scenario differ by the first.
std::string NameOf(const Recording& recording) {
  return fmt::format("{} ({})", recording.directory().filename().string(),
                     recording.info().scenario_name);
}

}  // namespace

Comparison Compare(const std::filesystem::path& a, const std::filesystem::path& b) {
  const Recording recording_a(a), recording_b(b);
  Comparison comparison;
  comparison.name_a = NameOf(recording_a);
  comparison.name_b = NameOf(recording_b);
  for (const auto& [name_a, name_b] : MatchMachines(recording_a, recording_b)) {
    comparison.machines.push_back(CompareMachine(recording_a, recording_b, name_a, name_b));
  }
  return comparison;
}

std::string ComparisonTable(const Comparison& comparison) {
  std::string text =
      fmt::format("reference: {}\ncompared:  {}\n", comparison.name_a, comparison.name_b);
  const auto out = std::back_inserter(text);
  for (const MachineComparison& machine : comparison.machines) {
    fmt::format_to(out, "\n{}{}\n", machine.name_a,
                   machine.name_a == machine.name_b ? "" : " and " + machine.name_b);
    if (machine.HasTrajectories()) AppendTrajectory(&text, machine);
    if (machine.channels.empty()) continue;
    fmt::format_to(out, "  {:<40}{:>12}{:>12}{:>9}\n", "channel, in its own unit", "rmse", "mean",
                   "samples");
    for (const ChannelDifference& d : machine.channels) {
      fmt::format_to(out, "  {:<40}{:>12.5g}{:>12.5g}{:>9}\n", d.channel + " " + d.column, d.rmse,
                     d.mean, d.count);
    }
  }
  return text;
}

void PlotComparison(const Comparison& comparison, const std::filesystem::path& png) {
  constexpr int kColumns = 3, kWidth_px = 1500, kRowHeight_px = 500;
  std::vector<Chart> charts;
  for (const MachineComparison& m : comparison.machines) {
    if (!m.HasTrajectories()) continue;
    charts.push_back({m.name_a + ": from above, SE(2) aligned",
                      "x in m",
                      "y in m",
                      true,
                      {PathCurve(comparison.name_a, m.a, Pose::Identity()),
                       PathCurve(comparison.name_b, m.b, m.aligned_se2.X_WV)}});
    const auto errors = [&](double PoseErrorSample::*member, double unit) {
      return std::vector<Curve>{ErrorCurve("not aligned", m.unaligned, member, unit),
                                ErrorCurve("SE(2)", m.aligned_se2, member, unit),
                                ErrorCurve("SE(3)", m.aligned_se3, member, unit)};
    };
    charts.push_back({"APE, translation", "time in s", "m", false,
                      errors(&PoseErrorSample::translation_m, 1.0)});
    charts.push_back(
        {"APE, rotation", "time in s", "deg", false, errors(&PoseErrorSample::rotation_rad, kDeg)});
  }
  if (charts.empty()) {
    throw InputError(
        fmt::format("{}: the recordings have no poses of one machine in common, so "
                    "there is nothing to plot",
                    png.string()));
  }
  const int rows = static_cast<int>(charts.size()) / kColumns;
  DrawCharts(charts, kColumns, kWidth_px, rows * kRowHeight_px, png);
}

}  // namespace tera
