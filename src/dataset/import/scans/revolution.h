#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/types/measurement.h"

/// Revolution in progress and its clock, shared by the packet decoders.

namespace tera {

/// One scan of a unit.
struct UnitScan {
  LidarScan scan;
  std::string place;  ///< first packet or message, for faults
  double turn = 1;    ///< covered share of a whole turn
  std::int64_t rays = 0;
  std::int64_t second_returns = 0;  ///< rays with two returns, kept or not
};
using TakeScan = std::function<void(UnitScan scan)>;

/// Choice of the returns that become points.
enum class ReturnsKept { kStrongest, kAll };

/// One return of a ray.
struct UnitReturn {
  double range_m = 0;  ///< 0: none
  std::uint8_t reflectivity = 0;
};

/// Converts the unit's times to those of the scans.
///
/// Model   by the unit's clock, unchanged; or by the receiver's. In the latter case the first
///         packet of a scan counts as received when its first ray left, and later times follow the
///         unit's clock.
class UnitClock {
 public:
  explicit UnitClock(bool is_unit) : is_unit_(is_unit) {}

  /// Synchronises the clocks at the first packet of a scan.
  void Anchor(TimeNs received_ns, TimeNs unit_ns) {
    if (!is_unit_) ahead_ns_ = received_ns - unit_ns;
  }
  TimeNs Of(TimeNs unit_ns) const { return unit_ns + ahead_ns_; }
  bool is_unit() const { return is_unit_; }

 private:
  bool is_unit_;
  TimeNs ahead_ns_ = 0;
};

/// Collects the points of scans one after another.
class Revolution {
 public:
  explicit Revolution(TakeScan take) : take_(std::move(take)) {}

  bool is_empty() const { return rays_ == 0; }
  void Begin(std::string place) { place_ = std::move(place); }
  /// A ray that left at `t_ns`, with or without a return.
  void AddRay(TimeNs t_ns);
  void AddPoint(const LidarPoint& point, TimeNs t_ns);
  void CountSecondReturn() { ++second_returns_; }
  /// Passes on the scan and starts the next. Points are sorted by time. Throws InputError where
  /// their times exceed the range of LidarPoint.
  void End(double turn);

 private:
  struct TimedPoint {
    LidarPoint point;
    TimeNs t_ns;
  };

  TakeScan take_;
  std::string place_;
  std::vector<TimedPoint> points_;
  TimeNs first_ns_ = 0;
  std::int64_t rays_ = 0, second_returns_ = 0;
};

/// Returns of one ray that become points: none, one, or with kAll two at different ranges. A single
/// return is the stronger one, or the nearer of equally strong ones.
std::vector<UnitReturn> KeptReturns(const UnitReturn& a, const UnitReturn& b, ReturnsKept kept);

/// Rings of beams by descending elevation, 0 at the top.
std::vector<std::uint16_t> RingsOf(const std::vector<double>& elevations);

}  // namespace tera
