#include "dataset/export/packets/velodyne_packets.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "dataset/export/packets/capture_writer.h"
#include "dataset/export/packets/pulse_grid.h"
#include "dataset/import/scans/packet_bytes.h"
#include "dataset/import/scans/revolution.h"

namespace tera {
namespace {

using Layout = VelodyneLayout;

constexpr std::uint16_t kPort = 2368;
constexpr double kTurn_deg = 360, kStep_deg = 0.01;
constexpr TimeNs kMicrosecond_ns = 1000, kHour_us = 3'600'000'000;

/// The laser of each ring.
std::vector<std::size_t> LasersOf(const VelodyneUnit& unit) {
  const std::vector<std::uint16_t> rings = RingsOf(unit.elevation_deg);
  std::vector<std::size_t> lasers(rings.size());
  for (std::size_t laser = 0; laser < rings.size(); ++laser) lasers[rings[laser]] = laser;
  return lasers;
}

std::uint8_t ModeOf(const LidarPattern& pattern) {
  if (pattern.returns == 2) return Layout::kDual;
  return pattern.pick == "last" ? Layout::kLast : Layout::kStrongest;
}

class VelodyneWriter : public PacketWriter {
 public:
  VelodyneWriter(const VelodyneUnit& unit, LidarPattern pattern, std::filesystem::path file)
      : unit_(unit),
        pattern_(std::move(pattern)),
        laser_of_ring_(LasersOf(unit)),
        ranges_{unit.range_step_m, std::numeric_limits<std::uint16_t>::max()},
        none_(LidarScan{}, pattern_, ranges_, ""),
        is_dual_(pattern_.returns == 2),
        capture_(file += ".pcap", kPort) {
    const auto blocks = static_cast<int>(Layout::kBlocks) / (is_dual_ ? 2 : 1);
    columns_per_packet_ = blocks * unit_.sequences_per_block;
  }

  void Take(const LidarScan& scan, TimeNs start_ns, const std::string& place) override {
    const PulseGrid grid(scan, pattern_, ranges_, place);
    const auto tolerance_ns = static_cast<TimeNs>(1e3 * pattern_.column_us() / 2);
    if (next_ns_ && start_ns < *next_ns_ - tolerance_ns) {
      throw InputError(place, {FaultKind::kInconsistent,
                               fmt::format("begins {:.6f} s before the scan before it ends, which "
                                           "packets cannot say; need scans one turn apart, without "
                                           "jitter of their stamps",
                                           ToSeconds(*next_ns_ - start_ns))});
    }
    if (next_ns_ && start_ns > *next_ns_ + tolerance_ns) FillPacket();
    for (int column = 0; column < pattern_.columns; ++column) {
      AddColumn(grid, column, start_ns + pattern_.ColumnStart(column));
    }
    next_ns_ = start_ns + pattern_.ColumnStart(pattern_.columns);
  }

  void Finish() override {
    FillPacket();
    capture_.Commit();
  }

 private:
  /// Completes a packet with columns behind the last scan.
  void FillPacket() {
    for (int column = 0; columns_ > 0; ++column) {
      AddColumn(none_, column % pattern_.columns, *next_ns_ + pattern_.ColumnStart(column));
    }
  }

  void AddColumn(const PulseGrid& grid, int column, TimeNs t_ns) {
    if (columns_ == 0) {
      first_ns_ = t_ns;
      packet_.assign(Layout::kPacketBytes, '\0');
    }
    const int sequence = columns_ % unit_.sequences_per_block;
    const auto block =
        static_cast<std::size_t>(columns_ / unit_.sequences_per_block * (is_dual_ ? 2 : 1));
    if (sequence == 0) {
      BeginBlock(block, column);
      if (is_dual_) BeginBlock(block + 1, column);
    }
    for (std::size_t ring = 0; ring < pattern_.rings(); ++ring) {
      const PulseReturns& pulse = grid.At(column, ring);
      const std::size_t k =
          static_cast<std::size_t>(sequence) * pattern_.rings() + laser_of_ring_[ring];
      if (!is_dual_) {
        PutReturn(block, k, pulse[0]);
        continue;
      }
      const bool is_swapped = pulse[1].steps > pulse[0].steps;
      const PacketReturn& last = pulse[is_swapped ? 1 : 0];
      const PacketReturn& other = pulse[is_swapped ? 0 : 1];
      PutReturn(block, k, last);
      PutReturn(block + 1, k, other.steps == 0 ? last : other);
    }
    if (++columns_ == columns_per_packet_) Send(t_ns);
  }

  void BeginBlock(std::size_t block, int column) {
    const double azimuth_deg = kTurn_deg / 2 + kTurn_deg * column / pattern_.columns;
    constexpr long kSteps = 36'000;
    PutPacketNumber(Layout::kBlockFlag, block * Layout::kBlockBytes, &packet_);
    PutPacketNumber(static_cast<std::uint16_t>(std::lround(azimuth_deg / kStep_deg) % kSteps),
                    block * Layout::kBlockBytes + 2, &packet_);
  }

  void PutReturn(std::size_t block, std::size_t k, const PacketReturn& one) {
    const std::size_t at =
        block * Layout::kBlockBytes + Layout::kBlockHead + k * Layout::kReturnBytes;
    PutPacketNumber(static_cast<std::uint16_t>(one.steps), at, &packet_);
    PutPacketNumber(one.reflectivity, at + 2, &packet_);
  }

  void Send(TimeNs last_ns) {
    const TimeNs stamp_us = (first_ns_ + kMicrosecond_ns / 2) / kMicrosecond_ns % kHour_us;
    PutPacketNumber(static_cast<std::uint32_t>(stamp_us), Layout::kStampAt, &packet_);
    PutPacketNumber(ModeOf(pattern_), Layout::kModeAt, &packet_);
    PutPacketNumber(unit_.factory_byte, Layout::kFactoryAt, &packet_);
    capture_.Add(last_ns + std::llround(1e3 * Layout::kSequence_us), packet_);
    columns_ = 0;
  }

  const VelodyneUnit& unit_;
  const LidarPattern pattern_;
  const std::vector<std::size_t> laser_of_ring_;
  const RangeSteps ranges_;
  const PulseGrid none_;  ///< a scan without returns
  const bool is_dual_;
  CaptureWriter capture_;
  int columns_per_packet_ = 0, columns_ = 0;
  std::string packet_;
  TimeNs first_ns_ = 0;
  std::optional<TimeNs> next_ns_;  ///< end of the last scan
};

}  // namespace

std::string WhyNotVelodyne(const LidarPattern& pattern, const VelodyneUnit& unit) {
  constexpr double kMostOff_deg = 0.005, kMostOff_us = 0.01;
  if (pattern.rings() != unit.elevation_deg.size()) {
    return fmt::format("elevation_deg has {} beams, need {}", pattern.rings(),
                       unit.elevation_deg.size());
  }
  const std::vector<std::size_t> lasers = LasersOf(unit);
  for (std::size_t ring = 0; ring < lasers.size(); ++ring) {
    const std::size_t laser = lasers[ring];
    const auto differs = [&](double value, double need, double most) {
      return std::abs(value - need) > most;
    };
    if (differs(pattern.elevation_deg[ring], unit.elevation_deg[laser], kMostOff_deg)) {
      return fmt::format("elevation_deg of ring {} is {:g}, need {:g}", ring,
                         pattern.elevation_deg[ring], unit.elevation_deg[laser]);
    }
    if (differs(-pattern.azimuth_offset_deg[ring], unit.azimuth_offset_deg[laser], kMostOff_deg)) {
      return fmt::format("azimuth_offset_deg of ring {} is {:g}, need {:g}", ring,
                         pattern.azimuth_offset_deg[ring], -unit.azimuth_offset_deg[laser]);
    }
    if (differs(pattern.firing_us[ring], unit.firing_us[laser], kMostOff_us)) {
      return fmt::format("firing_offset_us of ring {} is {:g}, need {:g}", ring,
                         pattern.firing_us[ring], unit.firing_us[laser]);
    }
  }
  if (!pattern.is_clockwise) return "clockwise is false, need true";
  const auto columns = std::lround(1e6 / (pattern.rate_hz * Layout::kSequence_us));
  if (pattern.columns != columns) {
    return fmt::format("columns is {}, need {} at {:g} Hz", pattern.columns, columns,
                       pattern.rate_hz);
  }
  if (pattern.returns > 2) return fmt::format("returns is {}, need 1 or 2", pattern.returns);
  if (pattern.pick == "first") return "pick is first, need strongest or last";
  return "";
}

std::unique_ptr<PacketWriter> MakeVelodyneWriter(const VelodyneUnit& unit,
                                                 const LidarPattern& pattern,
                                                 const std::filesystem::path& file) {
  return std::make_unique<VelodyneWriter>(unit, pattern, file);
}

}  // namespace tera
