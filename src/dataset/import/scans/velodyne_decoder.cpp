#include "dataset/import/scans/velodyne_decoder.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "core/units.h"
#include "dataset/import/scans/packet_bytes.h"

namespace tera {
namespace {

using Layout = VelodyneLayout;

constexpr TimeNs kHour_ns = 3600 * kNsPerSecond, kMicrosecond_ns = 1000;
constexpr double kTurn_deg = 360;
/// At 1200 rpm a VLP-16 turns by 0.8 degrees during two firing sequences. A larger step is a gap.
constexpr double kMostGap_deg = 2;

/// Model name for a factory byte, such as "VLP-16 or Puck LITE".
std::string ModelText(std::uint8_t byte) {
  switch (byte) {
    case 0x21:
      return "an HDL-32E";
    case 0x22:
      return "a VLP-16";
    case 0x24:
      return "a Puck Hi-Res";
    case 0x28:
      return "a VLP-32C";
    case 0xa1:
      return "a VLS-128";
    default:
      return fmt::format("a unit of the factory byte {:#x}", byte);
  }
}

double TurnFrom(double from_deg, double to_deg) {
  return std::fmod(to_deg - from_deg + kTurn_deg, kTurn_deg);
}

class VelodyneDecoder : public PacketDecoder {
 public:
  VelodyneDecoder(const VelodyneUnit& unit, const DecodeOptions& options, TakeScan take)
      : unit_(unit),
        options_(options),
        clock_(options.by_unit_clock),
        revolution_(std::move(take)),
        rings_(RingsOf(unit.elevation_deg)) {
    for (std::size_t n = 0; n < rings_.size(); ++n) {
      const double w = unit.elevation_deg[n] * kDeg;
      sines_.push_back(std::sin(w));
      cosines_.push_back(std::cos(w));
    }
  }

  void Take(const UnitPacket& packet) override {
    RequireOwn(packet);
    const TimeNs unit_ns = TimeOf(packet);
    const bool is_dual = PacketNumber<std::uint8_t>(packet.bytes, Layout::kModeAt) == Layout::kDual;
    const std::size_t step = is_dual ? 2 : 1;
    const double block_us = Layout::kSequence_us * unit_.sequences_per_block;
    double gap_deg = 0;
    for (std::size_t b = 0; b < Layout::kBlocks; b += step) {
      const double azimuth_deg = AzimuthOf(packet, b);
      const std::size_t from = b + step < Layout::kBlocks ? b : b - step;
      const double next_deg = TurnFrom(AzimuthOf(packet, from), AzimuthOf(packet, from + step));
      if (next_deg <= kMostGap_deg) gap_deg = next_deg;
      if (!last_deg_ || azimuth_deg + kTurn_deg / 2 < *last_deg_) Begin(packet, unit_ns);
      if (revolution_.is_empty()) first_deg_ = azimuth_deg;
      last_deg_ = azimuth_deg;
      const double start_us = block_us * static_cast<double>(b / step);
      TakeBlock({packet.bytes, b, is_dual}, {azimuth_deg, gap_deg, unit_ns, start_us});
    }
  }

  void Finish() override {
    if (revolution_.is_empty()) return;
    revolution_.End((*last_deg_ - first_deg_) / kTurn_deg);
  }

 private:
  struct Block {
    std::string_view packet;
    std::size_t number;
    bool is_dual;
  };
  struct BlockTurn {
    double azimuth_deg, gap_deg;
    TimeNs unit_ns;   ///< time of the packet
    double start_us;  ///< start of the block, in us after unit_ns
  };

  void RequireOwn(const UnitPacket& packet) const {
    if (packet.bytes.size() != Layout::kPacketBytes) {
      RefusePacket(packet,
                   fmt::format("has {} bytes, need {} of a {}; is the port the lidar's?{}",
                               packet.bytes.size(), Layout::kPacketBytes, unit_.name, kOrLeaveOut));
    }
    for (std::size_t b = 0; b < Layout::kBlocks; ++b) {
      if (PacketNumber<std::uint16_t>(packet.bytes, b * Layout::kBlockBytes) !=
          Layout::kBlockFlag) {
        RefusePacket(packet, fmt::format("its block {} does not begin with ff ee as those of a {} "
                                         "do{}",
                                         b + 1, unit_.name, kOrLeaveOut));
      }
      if (AzimuthOf(packet, b) >= kTurn_deg) {
        RefusePacket(packet, fmt::format("its block {} has the azimuth {:.2f} deg, need less than "
                                         "360{}",
                                         b + 1, AzimuthOf(packet, b), kOrLeaveOut));
      }
    }
    const auto factory = PacketNumber<std::uint8_t>(packet.bytes, Layout::kFactoryAt);
    if (factory == unit_.factory_byte) return;
    RefusePacket(packet,
                 fmt::format("is of {} by its factory byte, but the mapping's unit is a {}; name "
                             "the right unit (vlp16, vlp32c)",
                             ModelText(factory), unit_.name),
                 FaultKind::kInconsistent);
  }

  static double AzimuthOf(const UnitPacket& packet, std::size_t block) {
    constexpr double kStep_deg = 0.01;
    return kStep_deg * PacketNumber<std::uint16_t>(packet.bytes, block * Layout::kBlockBytes + 2);
  }

  /// The unit's time counts from the full hour. The receiver's clock supplies the hour.
  TimeNs TimeOf(const UnitPacket& packet) {
    const TimeNs in_hour_ns =
        kMicrosecond_ns * PacketNumber<std::uint32_t>(packet.bytes, Layout::kStampAt);
    if (!last_ns_ && clock_.is_unit()) {
      hour_ns_ = (packet.received_ns - in_hour_ns + kHour_ns / 2) / kHour_ns * kHour_ns;
    }
    TimeNs unit_ns = hour_ns_ + in_hour_ns;
    if (last_ns_ && unit_ns < *last_ns_ - kHour_ns / 2) {
      hour_ns_ += kHour_ns;
      unit_ns += kHour_ns;
    }
    if (last_ns_ && unit_ns < *last_ns_) {
      RefusePacket(packet,
                   fmt::format("its stamp goes back by {:.6f} s from the packet before{}",
                               ToSeconds(*last_ns_ - unit_ns), kOrLeaveOut),
                   FaultKind::kInconsistent);
    }
    last_ns_ = unit_ns;
    return unit_ns;
  }

  void Begin(const UnitPacket& packet, TimeNs unit_ns) {
    Finish();
    clock_.Anchor(packet.received_ns, unit_ns);
    revolution_.Begin(packet.place);
  }

  UnitReturn ReturnOf(std::string_view packet, std::size_t block, std::size_t k) const {
    const std::size_t at =
        block * Layout::kBlockBytes + Layout::kBlockHead + k * Layout::kReturnBytes;
    return {unit_.range_step_m * PacketNumber<std::uint16_t>(packet, at),
            PacketNumber<std::uint8_t>(packet, at + 2)};
  }

  void TakeBlock(const Block& block, const BlockTurn& turn) {
    const std::size_t lasers = rings_.size();
    const double block_us = Layout::kSequence_us * unit_.sequences_per_block;
    for (std::size_t k = 0; k < lasers * static_cast<std::size_t>(unit_.sequences_per_block); ++k) {
      const std::size_t laser = k % lasers;
      const double since_us =
          Layout::kSequence_us * static_cast<double>(k / lasers) + unit_.firing_us[laser];
      const TimeNs t_ns = clock_.Of(turn.unit_ns + std::llround(1e3 * (turn.start_us + since_us)));
      revolution_.AddRay(t_ns);
      const UnitReturn last = ReturnOf(block.packet, block.number, k);
      const UnitReturn other =
          block.is_dual ? ReturnOf(block.packet, block.number + 1, k) : UnitReturn{};
      const auto both = KeptReturns(last, other, ReturnsKept::kAll);
      if (both.size() > 1) revolution_.CountSecondReturn();
      const double alpha = kDeg * (turn.azimuth_deg + turn.gap_deg * since_us / block_us +
                                   unit_.azimuth_offset_deg[laser]);
      for (const UnitReturn& one : KeptReturns(last, other, options_.returns)) {
        AddPoint(one, laser, alpha, t_ns);
      }
    }
  }

  void AddPoint(const UnitReturn& one, std::size_t laser, double alpha, TimeNs t_ns) {
    const double level_m = one.range_m * cosines_[laser];
    revolution_.AddPoint(
        {.x_m = static_cast<float>(level_m * std::cos(alpha)),
         .y_m = static_cast<float>(-level_m * std::sin(alpha)),
         .z_m = static_cast<float>(one.range_m * sines_[laser] + unit_.origin_z_m[laser]),
         .intensity = one.reflectivity / kFullReflectivity,
         .ring = rings_[laser]},
        t_ns);
  }

  const VelodyneUnit& unit_;
  const DecodeOptions options_;
  UnitClock clock_;
  Revolution revolution_;
  std::vector<std::uint16_t> rings_;
  std::vector<double> sines_, cosines_;
  std::optional<double> last_deg_;
  double first_deg_ = 0;
  std::optional<TimeNs> last_ns_;
  TimeNs hour_ns_ = 0;
};

}  // namespace

std::unique_ptr<PacketDecoder> MakeVelodyneDecoder(const VelodyneUnit& unit,
                                                   const DecodeOptions& options, TakeScan take) {
  return std::make_unique<VelodyneDecoder>(unit, options, std::move(take));
}

}  // namespace tera
