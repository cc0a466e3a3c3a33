#include "dataset/compare/scan_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <numeric>

#include "core/types/labels.h"
#include "dataset/compare/binned_values.h"
#include "dataset/compare/cloud_distance.h"
#include "dataset/compare/ray_pairs.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {
namespace {

constexpr double kBright = 1.0 / 255;  ///< threshold for reflectivity ratios: one step of an 8-bit
                                       ///< unit
constexpr std::int64_t kFewestRays = 20;  ///< fewest rays of a class that is reported

double RangeOf_m(const LidarPoint& p) {
  return std::hypot(static_cast<double>(p.x_m), static_cast<double>(p.y_m),
                    static_cast<double>(p.z_m));
}

double MeanOf(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::size_t RangeBin(double range_m) {
  std::size_t bin = kRangeLimits_m.size() - 1;
  while (bin > 0 && range_m < kRangeLimits_m[bin]) --bin;
  return bin;
}

/// Sums over the points of one recording.
class SideSums {
 public:
  /// `rays` is the number of rays per scan, 0 if unknown.
  explicit SideSums(int rays) : rays_(rays) {}

  void Add(const LidarScan& scan) {
    ++scans_;
    first_returns_ += static_cast<std::int64_t>(FirstReturns(scan).size());
    for (const LidarPoint& point : scan.points) {
      ++ranges_[RangeBin(RangeOf_m(point))];
      reflectivity_.Add(static_cast<double>(point.intensity));
    }
    for (const PlaneDeviation& one : DeviationsOnPlanes(scan.points)) {
      deviation_m_[RangeBin(one.range_m)].Add(std::abs(one.deviation_m));
    }
  }
  ScanSide Told() const {
    ScanSide side{.points = reflectivity_.count()};
    side.second_returns = side.points - first_returns_;
    if (rays_ > 0) {
      side.without_return =
          1 - static_cast<double>(first_returns_) / (static_cast<double>(rays_) * scans_);
    }
    for (std::size_t k = 0; k < ranges_.size() && side.points > 0; ++k) {
      side.range_share[k] = static_cast<double>(ranges_[k]) / static_cast<double>(side.points);
      if (deviation_m_[k].count() < kFewestOnPlanes) continue;
      side.plane_deviation_m[k] = kSigmaOfMedian * deviation_m_[k].Quantile(0.5);
    }
    for (std::size_t k = 0; k < kReflectivityShares.size(); ++k) {
      side.reflectivity[k] = reflectivity_.Quantile(kReflectivityShares[k]);
    }
    return side;
  }

 private:
  static constexpr double kStep = 1.0 / 2550;  ///< ten bins per step of an 8-bit unit, centred on
                                               ///< the steps
  static constexpr double kSigmaOfMedian = 1.4826;  ///< converts the median absolute deviation to a
                                                    ///< standard deviation, for a normal
                                                    ///< distribution
  static constexpr std::int64_t kFewestOnPlanes = 30;
  int rays_, scans_ = 0;
  std::int64_t first_returns_ = 0;
  std::array<std::int64_t, kRangeLimits_m.size()> ranges_{};
  std::vector<BinnedValues> deviation_m_{kRangeLimits_m.size(), BinnedValues{0, 1, 0.0001}};
  BinnedValues reflectivity_{-0.5 * kStep, 1, kStep};
};

/// Sums of distances over all frames.
struct DistanceSums {
  BinnedValues values{0, 20, 0.0001};

  void Add(const std::vector<double>& distances_m) {
    for (const double distance_m : distances_m) values.Add(distance_m);
  }
  DistanceFigures Told() const {
    return {values.count(), values.mean(), values.Quantile(0.5), values.Quantile(0.95)};
  }
};

/// Sums over the frames of one lidar.
class ScanSums {
 public:
  ScanSums(int rays_a, int rays_b) : a_(rays_a), b_(rays_b) {}

  void Add(const FramePair& t, const LidarScan& a, const LidarScan& b) {
    a_.Add(a);
    b_.Add(b);
    AddRays(a, b);
    const CloudDistances from_a = DistancesFrom(a.points, b.points);
    const CloudDistances from_b = DistancesFrom(b.points, a.points);
    b_to_a_.Add(from_a.to_point_m);
    b_to_surface_.Add(from_a.to_surface_m);
    a_to_b_.Add(from_b.to_point_m);
    a_to_surface_.Add(from_b.to_surface_m);
    if (a.points.empty() || b.points.empty()) return;
    const double chamfer_m = MeanOf(from_a.to_point_m) + MeanOf(from_b.to_point_m);
    chamfer_m_.push_back(chamfer_m);
    KeepWorst({t, chamfer_m}, &worst_);
  }

  ScanComparison Told(SensorInBoth sensor) const {
    ScanComparison told{.sensor = std::move(sensor), .a = a_.Told(), .b = b_.Told()};
    told.rays_both = range_m_.count();
    told.rays_only_a = only_a_;
    told.rays_only_b = only_b_;
    AddClasses(of_a_, false, &told);
    AddClasses(of_b_, true, &told);
    told.range_mean_m = range_m_.mean();
    told.range_median_m = range_m_.Quantile(0.5);
    told.range_rms_m = range_m_.rms();
    told.reflectivity_ratio = ratio_.Quantile(0.5);
    told.a_to_b = a_to_b_.Told();
    told.b_to_a = b_to_a_.Told();
    told.a_to_surface = a_to_surface_.Told();
    told.b_to_surface = b_to_surface_.Told();
    told.chamfer_m = MeanOf(chamfer_m_);
    told.worst = worst_;
    return told;
  }

 private:
  struct Rays {
    std::int64_t all = 0, lost = 0;
  };
  using RaysOfClasses = std::array<Rays, kSemanticClasses.size()>;

  static void Count(const LidarPoint& point, bool is_lost, RaysOfClasses* classes) {
    if (point.label >= classes->size()) return;
    ++(*classes)[point.label].all;
    (*classes)[point.label].lost += is_lost ? 1 : 0;
  }

  void AddRays(const LidarScan& a, const LidarScan& b) {
    const RayPairs pairs = PairRays(a, b);
    only_a_ += static_cast<std::int64_t>(pairs.only_a.size());
    only_b_ += static_cast<std::int64_t>(pairs.only_b.size());
    for (const std::size_t k : pairs.only_a) Count(a.points[k], true, &of_a_);
    for (const std::size_t k : pairs.only_b) Count(b.points[k], true, &of_b_);
    for (const auto& [in_a, in_b] : pairs.both) {
      const LidarPoint &p_a = a.points[in_a], &p_b = b.points[in_b];
      Count(p_a, false, &of_a_);
      Count(p_b, false, &of_b_);
      range_m_.Add(RangeOf_m(p_b) - RangeOf_m(p_a));
      const double bright = static_cast<double>(p_a.intensity);
      if (bright >= kBright) ratio_.Add(static_cast<double>(p_b.intensity) / bright);
    }
  }

  /// Class 0 is skipped: points of real lidars have no class, and the sky gives no return.
  static void AddClasses(const RaysOfClasses& classes, bool is_of_b, ScanComparison* told) {
    for (std::size_t c = 1; c < classes.size(); ++c) {
      if (classes[c].all < kFewestRays) continue;
      told->classes.push_back(
          {std::string(kSemanticClasses[c].name), is_of_b, classes[c].all, classes[c].lost});
    }
  }

  SideSums a_, b_;
  std::int64_t only_a_ = 0, only_b_ = 0;
  RaysOfClasses of_a_{}, of_b_{};
  BinnedValues range_m_{-10, 10, 0.0001}, ratio_{0, 20, 0.001};
  DistanceSums a_to_b_, b_to_a_, a_to_surface_, b_to_surface_;
  std::vector<double> chamfer_m_;
  std::vector<WorstFrame> worst_;
};

int RaysOfSheet(const Recording& recording, const std::string& folder) {
  return ReadSensorSheet(recording.directory() / folder).lidar_rays;
}

double Percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

std::string RangeText() {
  std::string text = fmt::format("    {:<30}", "range, % of points");
  for (std::size_t k = 0; k + 1 < kRangeLimits_m.size(); ++k) {
    text += fmt::format("{:>9}", fmt::format("{}-{} m", kRangeLimits_m[k], kRangeLimits_m[k + 1]));
  }
  return text + fmt::format("{:>9}\n", fmt::format(">{} m", kRangeLimits_m.back()));
}

std::string SharesText(const char* title, const ScanSide& side) {
  std::string text = fmt::format("    {:<30}", title);
  for (const double share : side.range_share) text += fmt::format("{:>9.1f}", 100 * share);
  return text + "\n";
}

std::string DeviationText(const char* title, const ScanSide& side) {
  std::string text = fmt::format("    {:<30}", title);
  for (const auto& deviation_m : side.plane_deviation_m) {
    text += deviation_m ? fmt::format("{:>9.1f}", 1000 * *deviation_m) : fmt::format("{:>9}", "-");
  }
  return text + "\n";
}

std::string ReturnsText(const char* title, const ScanSide& side, std::int64_t scans) {
  return fmt::format(
      "    {:<30}{} points a scan, {:.2f} % second returns, rays without a return {}\n", title,
      side.points / scans, Percent(side.second_returns, side.points),
      side.without_return ? fmt::format("{:.1f} %", 100 * *side.without_return) : "not known");
}

std::string DistanceText(const char* title, const DistanceFigures& d) {
  return fmt::format("    {:<30}{:>9.3f}{:>9.3f}{:>9.3f}{:>10}\n", title, d.mean_m, d.median_m,
                     d.most_m, d.count);
}

}  // namespace

std::vector<ScanComparison> CompareScans(const RecordedMachine& a, const RecordedMachine& b,
                                         std::size_t every) {
  std::vector<ScanComparison> comparisons;
  for (SensorInBoth& sensor : SensorsInBoth(a, b, ChannelForm::kScans, every)) {
    ScanSums sums(RaysOfSheet(*a.recording, sensor.folder_a),
                  RaysOfSheet(*b.recording, sensor.folder_b));
    for (const FramePair& t : sensor.pairs) {
      sums.Add(t, a.recording->LoadScan(sensor.folder_a, t.a_ns),
               b.recording->LoadScan(sensor.folder_b, t.b_ns));
    }
    comparisons.push_back(sums.Told(std::move(sensor)));
  }
  return comparisons;
}

std::string ScanTable(const ScanComparison& c) {
  std::string text = fmt::format("  lidar {}: {} pairs of scans, of {} and {}\n", c.sensor.name,
                                 c.sensor.pairs.size(), c.sensor.frames_a, c.sensor.frames_b);
  if (!c.sensor.remark.empty()) text += fmt::format("    {}\n", c.sensor.remark);
  if (c.sensor.pairs.empty()) return text;
  const auto out = std::back_inserter(text);
  const auto scans = static_cast<std::int64_t>(c.sensor.pairs.size());
  const std::int64_t rays = c.rays_both + c.rays_only_a + c.rays_only_b;
  text += ReturnsText("reference", c.a, scans) + ReturnsText("compared", c.b, scans);
  fmt::format_to(
      out,
      "    rays with a return            both {:.1f} %, only reference {:.1f} %, only compared "
      "{:.1f} %\n",
      Percent(c.rays_both, rays), Percent(c.rays_only_a, rays), Percent(c.rays_only_b, rays));
  fmt::format_to(out,
                 "    range of rays in both, m      mean {:+.3f}, median {:+.3f}, rms {:.3f} "
                 "(compared less reference)\n",
                 c.range_mean_m, c.range_median_m, c.range_rms_m);
  text += RangeText() + SharesText("  reference", c.a) + SharesText("  compared", c.b);
  text += "    deviation on planes, mm\n" + DeviationText("  reference", c.a) +
          DeviationText("  compared", c.b);
  fmt::format_to(out,
                 "    reflectivity, quantiles 5, 25, 50, 75, 95 %: {:.3f} in the reference, "
                 "{:.3f} compared; ratio {:.3f}\n",
                 fmt::join(c.a.reflectivity, " "), fmt::join(c.b.reflectivity, " "),
                 c.reflectivity_ratio);
  fmt::format_to(out, "    {:<30}{:>9}{:>9}{:>9}{:>10}\n", "distances, m", "mean", "median", "95 %",
                 "points");
  text += DistanceText("  compared to nearest point", c.b_to_a);
  text += DistanceText("  reference to nearest point", c.a_to_b);
  text += DistanceText("  compared to surface", c.b_to_surface);
  text += DistanceText("  reference to surface", c.a_to_surface);
  fmt::format_to(out, "    Chamfer distance              {:.3f} m\n", c.chamfer_m);
  for (const ClassDropOut& one : c.classes) {
    fmt::format_to(out, "    {:<30}{:>5.1f} % of {} rays of the {} are lost in the {}\n", one.name,
                   Percent(one.lost, one.rays), one.rays, one.is_of_b ? "compared" : "reference",
                   one.is_of_b ? "reference" : "compared");
  }
  for (const WorstFrame& frame : c.worst) {
    fmt::format_to(out, "    worst at {:.3f} s: Chamfer distance {:.3f} m\n",
                   ToSeconds(frame.t.a_ns), frame.difference);
  }
  return text;
}

}  // namespace tera
