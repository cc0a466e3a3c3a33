#include "dataset/import/scans/revolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/error.h"

namespace tera {

void Revolution::AddRay(TimeNs t_ns) {
  first_ns_ = rays_++ == 0 ? t_ns : std::min(first_ns_, t_ns);
}

void Revolution::AddPoint(const LidarPoint& point, TimeNs t_ns) {
  points_.push_back({point, t_ns});
}

void Revolution::End(double turn) {
  UnitScan scan{
      .place = std::move(place_), .turn = turn, .rays = rays_, .second_returns = second_returns_};
  const std::vector<TimedPoint> points = std::exchange(points_, {});
  const TimeNs first_ns = first_ns_;
  rays_ = second_returns_ = 0;
  place_.clear();
  scan.scan.t_ns = scan.scan.t_available_ns = first_ns;
  scan.scan.points.reserve(points.size());
  for (const TimedPoint& timed : points) {
    const TimeNs offset_ns = timed.t_ns - first_ns;
    if (offset_ns < 0 || offset_ns > std::numeric_limits<std::uint32_t>::max()) {
      throw InputError(
          scan.place,
          {FaultKind::kInconsistent,
           fmt::format("the scan that begins here lasts {:.3f} s by its stamps, need at most 4.29 "
                       "s: was a clock set? skip such scans with --skip-bad-rows",
                       ToSeconds(offset_ns))});
    }
    scan.scan.points.push_back(timed.point);
    scan.scan.points.back().time_offset_ns = static_cast<std::uint32_t>(offset_ns);
  }
  std::stable_sort(
      scan.scan.points.begin(), scan.scan.points.end(),
      [](const LidarPoint& a, const LidarPoint& b) { return a.time_offset_ns < b.time_offset_ns; });
  take_(std::move(scan));
}

std::vector<UnitReturn> KeptReturns(const UnitReturn& a, const UnitReturn& b, ReturnsKept kept) {
  if (a.range_m == 0 && b.range_m == 0) return {};
  if (a.range_m == 0 || a.range_m == b.range_m) return {b};
  if (b.range_m == 0) return {a};
  const bool a_first =
      a.reflectivity != b.reflectivity ? a.reflectivity > b.reflectivity : a.range_m < b.range_m;
  if (kept == ReturnsKept::kStrongest) return {a_first ? a : b};
  return a_first ? std::vector{a, b} : std::vector{b, a};
}

std::vector<std::uint16_t> RingsOf(const std::vector<double>& elevations) {
  std::vector<std::size_t> order(elevations.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return elevations[a] > elevations[b]; });
  std::vector<std::uint16_t> rings(elevations.size());
  for (std::size_t k = 0; k < order.size(); ++k) rings[order[k]] = static_cast<std::uint16_t>(k);
  return rings;
}

}  // namespace tera
