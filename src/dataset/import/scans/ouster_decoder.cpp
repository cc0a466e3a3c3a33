#include "dataset/import/scans/ouster_decoder.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "dataset/import/scans/packet_bytes.h"

namespace tera {
namespace {

constexpr std::size_t kLegacyColumnHead = 16;

class OusterDecoder : public PacketDecoder {
 public:
  OusterDecoder(const OusterSheet& sheet, const DecodeOptions& options, TakeScan take)
      : sheet_(sheet),
        options_(options),
        clock_(options.by_unit_clock),
        revolution_(std::move(take)),
        arm_m_(std::hypot(sheet.beam_x_m, sheet.beam_z_m)),
        rings_(RingsOf(sheet.altitude_rad)) {}

  void Take(const UnitPacket& packet) override {
    RequireOwn(packet);
    const std::uint32_t frame = FrameOf(packet);
    if (frame_ && frame != *frame_) {
      // Frame numbers wrap at 65 536. A delayed packet belongs to the previous frame.
      const auto later = static_cast<std::int16_t>(static_cast<std::uint16_t>(frame - *frame_));
      if (later < 0) {
        RefusePacket(
            packet,
            fmt::format("is of frame {} and comes after frame {}{}", frame, *frame_, kOrLeaveOut),
            FaultKind::kInconsistent);
      }
      Finish();
    }
    if (!frame_) Begin(packet, frame);
    for (int c = 0; c < sheet_.columns_per_packet; ++c) {
      TakeColumn(packet, ColumnOf(packet.bytes, c));
    }
  }

  void Finish() override {
    if (!frame_) return;
    frame_.reset();
    if (revolution_.is_empty()) return;
    const int window = (sheet_.last_column - sheet_.first_column + sheet_.columns_per_frame) %
                           sheet_.columns_per_frame +
                       1;
    revolution_.End(columns_ / static_cast<double>(window));
  }

 private:
  void RequireOwn(const UnitPacket& packet) const {
    if (packet.bytes.size() == sheet_.packet_bytes()) {
      if (sheet_.is_legacy) return;
      if (PacketNumber<std::uint8_t>(packet.bytes, 0) == 1) return RequireOwnSerial(packet);
      RefusePacket(
          packet,
          "is not a lidar packet (kind 1); need the packets of the unit that the metadata describe",
          FaultKind::kInconsistent);
    }
    RefusePacket(
        packet,
        fmt::format(
            "has {} bytes, but the metadata's profile {} of {} beams gives {}: the metadata belong "
            "to another unit or setting; give the metadata of this recording",
            packet.bytes.size(), sheet_.profile, sheet_.beams, sheet_.packet_bytes()),
        FaultKind::kInconsistent);
  }

  /// Units of one model have equal packet sizes, so the 40-bit serial number in the header is
  /// compared.
  void RequireOwnSerial(const UnitPacket& packet) const {
    constexpr std::uint64_t k40Bits = 0xff'ffff'ffff;
    if (sheet_.is_fusa) return;  // headers of this profile differ
    const std::uint64_t serial = PacketNumber<std::uint64_t>(packet.bytes, 7) & k40Bits;
    if (serial == sheet_.serial || serial == 0 || sheet_.serial == 0) return;
    RefusePacket(
        packet,
        fmt::format("is of the unit {}, the metadata are of {} {}; give the metadata of that unit",
                    serial, sheet_.product, sheet_.serial),
        FaultKind::kInconsistent);
  }

  std::uint32_t FrameOf(const UnitPacket& packet) const {
    if (sheet_.is_legacy) return PacketNumber<std::uint16_t>(packet.bytes, 10);
    if (sheet_.is_fusa) return PacketNumber<std::uint32_t>(packet.bytes, 4);
    return PacketNumber<std::uint16_t>(packet.bytes, 2);
  }

  std::string_view ColumnOf(std::string_view packet, int column) const {
    const std::size_t head = sheet_.is_legacy ? 0 : kOusterPacketHead;
    return packet.substr(head + static_cast<std::size_t>(column) * sheet_.column_bytes(),
                         sheet_.column_bytes());
  }

  void Begin(const UnitPacket& packet, std::uint32_t frame) {
    frame_ = frame;
    columns_ = 0;
    is_anchored_ = false;
    revolution_.Begin(packet.place);
  }

  bool IsValid(std::string_view column) const {
    if (sheet_.is_legacy) {
      return PacketNumber<std::uint32_t>(column, column.size() - 4) == 0xffffffff;
    }
    return (PacketNumber<std::uint16_t>(column, 10) & 1) != 0;
  }

  void TakeColumn(const UnitPacket& packet, std::string_view column) {
    if (!IsValid(column)) return;
    const auto unit_ns = static_cast<TimeNs>(PacketNumber<std::uint64_t>(column, 0));
    const int number = PacketNumber<std::uint16_t>(column, 8);
    if (number >= sheet_.columns_per_frame) {
      RefusePacket(packet,
                   fmt::format("has column {}, but a turn has {} by the metadata; give the "
                               "metadata of this recording",
                               number, sheet_.columns_per_frame),
                   FaultKind::kInconsistent);
    }
    if (!is_anchored_) clock_.Anchor(packet.received_ns, unit_ns);
    is_anchored_ = true;
    ++columns_;
    const TimeNs t_ns = clock_.Of(unit_ns);
    const double theta =
        2 * std::numbers::pi * (1 - number / static_cast<double>(sheet_.columns_per_frame));
    std::size_t at = sheet_.is_legacy ? kLegacyColumnHead : kOusterColumnHead;
    for (std::size_t beam = 0; beam < rings_.size(); ++beam, at += sheet_.pixel.bytes) {
      revolution_.AddRay(t_ns);
      TakePixel(column.substr(at, sheet_.pixel.bytes), beam, theta, t_ns);
    }
  }

  UnitReturn ReturnOf(std::string_view pixel, std::size_t number) const {
    if (number >= sheet_.pixel.returns.size()) return {};
    const OusterPixel::Return& at = sheet_.pixel.returns[number];
    // The last range has 15 bits, and the pixel may end less than four bytes after it.
    std::uint32_t range = PacketNumber<std::uint16_t>(pixel, at.range_at);
    if (at.range_at + sizeof range <= pixel.size()) {
      range = PacketNumber<std::uint32_t>(pixel, at.range_at);
    }
    return {(range & sheet_.pixel.range_mask) * sheet_.pixel.range_step_m,
            PacketNumber<std::uint8_t>(pixel, at.reflectivity_at)};
  }

  void TakePixel(std::string_view pixel, std::size_t beam, double theta, TimeNs t_ns) {
    const UnitReturn first = ReturnOf(pixel, 0), second = ReturnOf(pixel, 1);
    if (first.range_m > 0 && second.range_m > 0) revolution_.CountSecondReturn();
    if (first.range_m > 0) AddPoint(first, beam, theta, t_ns);
    const bool keeps = options_.returns == ReturnsKept::kAll || first.range_m == 0;
    if (second.range_m > 0 && keeps) AddPoint(second, beam, theta, t_ns);
  }

  void AddPoint(const UnitReturn& one, std::size_t beam, double theta, TimeNs t_ns) {
    const double theta_i = theta - sheet_.azimuth_rad[beam], phi = sheet_.altitude_rad[beam];
    const double r_m = one.range_m - arm_m_;
    const Vec3 p_L(r_m * std::cos(theta_i) * std::cos(phi) + sheet_.beam_x_m * std::cos(theta),
                   r_m * std::sin(theta_i) * std::cos(phi) + sheet_.beam_x_m * std::sin(theta),
                   r_m * std::sin(phi) + sheet_.beam_z_m);
    const Eigen::Vector3f p_S = (sheet_.X_SL * p_L).cast<float>();
    revolution_.AddPoint({.x_m = p_S.x(),
                          .y_m = p_S.y(),
                          .z_m = p_S.z(),
                          .intensity = one.reflectivity / kFullReflectivity,
                          .ring = rings_[beam]},
                         t_ns);
  }

  const OusterSheet sheet_;
  const DecodeOptions options_;
  UnitClock clock_;
  Revolution revolution_;
  double arm_m_;
  std::vector<std::uint16_t> rings_;
  std::optional<std::uint32_t> frame_;
  int columns_ = 0;
  bool is_anchored_ = false;
};

}  // namespace

std::unique_ptr<PacketDecoder> MakeOusterDecoder(const OusterSheet& sheet,
                                                 const DecodeOptions& options, TakeScan take) {
  return std::make_unique<OusterDecoder>(sheet, options, std::move(take));
}

}  // namespace tera
