#include "dataset/import/scans/pandar_decoder.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "core/units.h"
#include "dataset/import/scans/packet_bytes.h"

namespace tera {
namespace {

constexpr std::size_t kPandarHead = 12, kPandarBlocks = 4, kPandarReturn = 4;
constexpr std::size_t kPandarBlock = 2 + kPandarReturn * kQt64Lasers;
constexpr std::size_t kPandarTail = kPandarHead + kPandarBlocks * kPandarBlock;
constexpr std::size_t kPandarBytes64 = kPandarTail + 24, kSequenceBytes = 4;
constexpr std::size_t kTailStamp = kPandarTail + 12, kTailDate = kPandarTail + 18;
constexpr double kPandarTurn_deg = 360, kPandarStep_m = 0.004;
constexpr double kFirstBlock_us = 25.71, kBlock_us = 500.0 / 3;

/// Firing time of each laser since the start of its block.
constexpr std::array<double, kQt64Lasers> kPandarFiring_us = {
    12.31,  14.37,  16.43,  18.49,  20.54,  22.60,  24.66,  26.71,  29.16,  31.22,  33.28,
    35.34,  37.39,  39.45,  41.50,  43.56,  46.61,  48.67,  50.73,  52.78,  54.84,  56.90,
    58.95,  61.01,  63.45,  65.52,  67.58,  69.63,  71.69,  73.74,  75.80,  77.86,  80.90,
    82.97,  85.02,  87.08,  89.14,  91.19,  93.25,  95.30,  97.75,  99.82,  101.87, 103.93,
    105.98, 108.04, 110.10, 112.15, 115.20, 117.26, 119.32, 121.38, 123.43, 125.49, 127.54,
    129.60, 132.05, 134.11, 136.17, 138.22, 140.28, 142.34, 144.39, 146.45};

class PandarDecoder : public PacketDecoder {
 public:
  PandarDecoder(const PandarAngles& angles, const DecodeOptions& options, TakeScan take)
      : angles_(angles),
        options_(options),
        clock_(options.by_unit_clock),
        revolution_(std::move(take)),
        rings_(RingsOf({angles.elevation_deg.begin(), angles.elevation_deg.end()})) {}

  void Take(const UnitPacket& packet) override {
    RequireOwn(packet);
    const TimeNs unit_ns = TimeOf(packet);
    const std::size_t step = PacketNumber<std::uint8_t>(packet.bytes, 10) == 2 ? 2 : 1;
    for (std::size_t b = 0; b < kPandarBlocks; b += step) {
      const double azimuth_deg = AzimuthOf(packet, b);
      if (!last_deg_ || azimuth_deg + kPandarTurn_deg / 2 < *last_deg_) Begin(packet, unit_ns);
      if (revolution_.is_empty()) first_deg_ = azimuth_deg;
      last_deg_ = azimuth_deg;
      const double start_us = kFirstBlock_us + kBlock_us * static_cast<double>(b / step);
      for (std::size_t laser = 0; laser < kQt64Lasers; ++laser) {
        const TimeNs t_ns =
            clock_.Of(unit_ns + std::llround(1e3 * (start_us + kPandarFiring_us[laser])));
        const UnitReturn first = ReturnOf(packet.bytes, b, laser);
        const UnitReturn other = step == 2 ? ReturnOf(packet.bytes, b + 1, laser) : UnitReturn{};
        TakeRay(first, other, laser, azimuth_deg, t_ns);
      }
    }
  }

  void Finish() override {
    if (revolution_.is_empty()) return;
    revolution_.End((*last_deg_ - first_deg_) / kPandarTurn_deg);
  }

 private:
  void RequireOwn(const UnitPacket& packet) const {
    const std::string_view bytes = packet.bytes;
    if (bytes.size() != kPandarBytes64 && bytes.size() != kPandarBytes64 + kSequenceBytes) {
      RefusePacket(packet, fmt::format("has {} bytes, need {} or {} of a QT64; is the port the "
                                       "lidar's?{}",
                                       bytes.size(), kPandarBytes64,
                                       kPandarBytes64 + kSequenceBytes, kOrLeaveOut));
    }
    const auto at = [&](std::size_t place) { return PacketNumber<std::uint8_t>(bytes, place); };
    if (at(0) != 0xee || at(1) != 0xff) {
      RefusePacket(packet, std::string("does not begin with ee ff, the start of a QT64 packet") +
                               kOrLeaveOut);
    }
    if (at(6) != kQt64Lasers || at(7) != kPandarBlocks || at(9) != 4) {
      RefusePacket(packet,
                   fmt::format("has {} lasers, {} blocks and steps of {} mm, need 64, 4 and 4 of a "
                               "QT64; name the right unit",
                               at(6), at(7), at(9)),
                   FaultKind::kInconsistent);
    }
    for (std::size_t b = 0; b < kPandarBlocks; ++b) {
      if (AzimuthOf(packet, b) < kPandarTurn_deg) continue;
      RefusePacket(packet, fmt::format("its block {} has the azimuth {:.2f} deg, need less than "
                                       "360{}",
                                       b + 1, AzimuthOf(packet, b), kOrLeaveOut));
    }
  }

  static double AzimuthOf(const UnitPacket& packet, std::size_t block) {
    constexpr double kStep_deg = 0.01;
    return kStep_deg *
           PacketNumber<std::uint16_t>(packet.bytes, kPandarHead + block * kPandarBlock);
  }

  /// Time of a packet from its fields for date, second and microseconds.
  TimeNs TimeOf(const UnitPacket& packet) {
    namespace chrono = std::chrono;
    const auto part = [&](std::size_t k) {
      return PacketNumber<std::uint8_t>(packet.bytes, kTailDate + k);
    };
    const chrono::year_month_day date{chrono::year{1900 + part(0)}, chrono::month{part(1)},
                                      chrono::day{part(2)}};
    if (!date.ok() || part(3) > 23 || part(4) > 59 || part(5) > 60) {
      RefusePacket(packet, std::string("has no date and time of day that exist") + kOrLeaveOut);
    }
    const TimeNs days = chrono::sys_days(date).time_since_epoch().count();
    const TimeNs seconds = ((days * 24 + part(3)) * 60 + part(4)) * 60 + part(5);
    const TimeNs unit_ns = seconds * kNsPerSecond +
                           TimeNs{1000} * PacketNumber<std::uint32_t>(packet.bytes, kTailStamp);
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

  static UnitReturn ReturnOf(std::string_view packet, std::size_t block, std::size_t laser) {
    const std::size_t at = kPandarHead + block * kPandarBlock + 2 + laser * kPandarReturn;
    return {kPandarStep_m * PacketNumber<std::uint16_t>(packet, at),
            PacketNumber<std::uint8_t>(packet, at + 2)};
  }

  void TakeRay(const UnitReturn& first, const UnitReturn& other, std::size_t laser,
               double azimuth_deg, TimeNs t_ns) {
    revolution_.AddRay(t_ns);
    if (KeptReturns(first, other, ReturnsKept::kAll).size() > 1) revolution_.CountSecondReturn();
    const double alpha = kDeg * (azimuth_deg + angles_.azimuth_deg[laser]);
    const double w = kDeg * angles_.elevation_deg[laser];
    for (const UnitReturn& one : KeptReturns(first, other, options_.returns)) {
      const double level_m = one.range_m * std::cos(w);
      revolution_.AddPoint({.x_m = static_cast<float>(level_m * std::cos(alpha)),
                            .y_m = static_cast<float>(-level_m * std::sin(alpha)),
                            .z_m = static_cast<float>(one.range_m * std::sin(w)),
                            .intensity = one.reflectivity / kFullReflectivity,
                            .ring = rings_[laser]},
                           t_ns);
    }
  }

  const PandarAngles angles_;
  const DecodeOptions options_;
  UnitClock clock_;
  Revolution revolution_;
  std::vector<std::uint16_t> rings_;
  std::optional<double> last_deg_;
  double first_deg_ = 0;
  std::optional<TimeNs> last_ns_;
};

}  // namespace

std::unique_ptr<PacketDecoder> MakePandarDecoder(const PandarAngles& angles,
                                                 const DecodeOptions& options, TakeScan take) {
  return std::make_unique<PandarDecoder>(angles, options, std::move(take));
}

}  // namespace tera
