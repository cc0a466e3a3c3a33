#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/types/measurement.h"

/// What decoders of packets share: a revolution that is being collected, and its time.

namespace tera {

/// A scan as a unit gave it.
struct UnitScan {
  LidarScan scan;
  std::string place;  ///< of its first packet or message, for faults
  double turn = 1;    ///< how much of a whole turn it covers
  std::int64_t rays = 0;
  std::int64_t second_returns = 0;  ///< of the rays, whether they are kept or not
};
using TakeScan = std::function<void(UnitScan scan)>;

/// Which of a ray's returns become points.
enum class ReturnsKept { kStrongest, kAll };

/// One return of a ray.
struct UnitReturn {
  double range_m = 0;  ///< 0: none
  std::uint8_t reflectivity = 0;
};

/// Turns the unit's own times into those of the scans.
///
/// Model   by the unit's clock itself; or by the receiver's: the first packet of a scan counts as
///         received when its first ray left, and the unit's clock goes on from there.
class UnitClock {
 public:
  explicit UnitClock(bool is_unit) : is_unit_(is_unit) {}

  /// At the first packet of a scan.
  void Anchor(TimeNs received_ns, TimeNs unit_ns) {
    if (!is_unit_) ahead_ns_ = received_ns - unit_ns;
  }
  TimeNs Of(TimeNs unit_ns) const { return unit_ns + ahead_ns_; }
  bool is_unit() const { return is_unit_; }

 private:
  bool is_unit_;
  TimeNs ahead_ns_ = 0;
};

/// Collects the points of one scan after the other.
class Revolution {
 public:
  explicit Revolution(TakeScan take) : take_(std::move(take)) {}

  bool is_empty() const { return rays_ == 0; }
  void Begin(std::string place) { place_ = std::move(place); }
  /// A ray that left at `t_ns`, whether it came back or not.
  void AddRay(TimeNs t_ns);
  void AddPoint(const LidarPoint& point, TimeNs t_ns);
  void CountSecondReturn() { ++second_returns_; }
  /// Hands the scan on and begins anew. Points are in the order of their times. Throws InputError
  /// where they lie further apart than LidarPoint can say.
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

/// The returns of one ray that become points: none, one, or with kAll two of different ranges.
/// Where one is kept it is the stronger, of equals the nearer.
std::vector<UnitReturn> KeptReturns(const UnitReturn& a, const UnitReturn& b, ReturnsKept kept);

/// Rings of beams by their elevations, 0 at the top.
std::vector<std::uint16_t> RingsOf(const std::vector<double>& elevations);

}  // namespace tera
