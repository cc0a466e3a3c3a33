#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/types/measurement.h"

/// The scan being assembled and its clock. All packet decoders use them.

namespace tera {

/// A complete scan of a unit.
struct UnitScan {
  LidarScan scan;
  std::string place;  ///< first packet or message, for error messages
  double turn = 1;    ///< fraction of a full turn that the scan covers
  std::int64_t rays = 0;
  std::int64_t second_returns = 0;  ///< number of rays with two returns, whether both are kept or
                                    ///< not
};
using TakeScan = std::function<void(UnitScan scan)>;

/// Selection of the returns that become points.
enum class ReturnsKept { kStrongest, kAll };

struct UnitReturn {
  double range_m = 0;  ///< 0: no return
  std::uint8_t reflectivity = 0;
};

/// Converts times of the unit to times of the scan.
///
/// Model   Times follow the unit's clock unchanged, or the receiver's clock. In the second case,
///         the reception time of a scan's first packet is taken as the time of its first ray.
///         Differences within the scan follow the unit's clock.
class UnitClock {
 public:
  explicit UnitClock(bool is_unit) : is_unit_(is_unit) {}

  /// Aligns the clocks at the first packet of a scan.
  void Anchor(TimeNs received_ns, TimeNs unit_ns) {
    if (!is_unit_) ahead_ns_ = received_ns - unit_ns;
  }
  TimeNs Of(TimeNs unit_ns) const { return unit_ns + ahead_ns_; }
  bool is_unit() const { return is_unit_; }

 private:
  bool is_unit_;
  TimeNs ahead_ns_ = 0;
};

/// Collects the points of consecutive scans.
class Revolution {
 public:
  explicit Revolution(TakeScan take) : take_(std::move(take)) {}

  bool is_empty() const { return rays_ == 0; }
  void Begin(std::string place) { place_ = std::move(place); }
  /// Adds a ray emitted at `t_ns`, with or without a return.
  void AddRay(TimeNs t_ns);
  void AddPoint(const LidarPoint& point, TimeNs t_ns);
  void CountSecondReturn() { ++second_returns_; }
  /// Emits the scan with points sorted by time, and starts the next. Throws InputError if the times
  /// exceed the range of LidarPoint.
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

/// Returns of a ray that become points: none, one, or with kAll two at different ranges. If one is
/// selected, it is the stronger; on a tie, the nearer.
std::vector<UnitReturn> KeptReturns(const UnitReturn& a, const UnitReturn& b, ReturnsKept kept);

/// Ring number of each beam; ring 0 has the highest elevation.
std::vector<std::uint16_t> RingsOf(const std::vector<double>& elevations);

}  // namespace tera
