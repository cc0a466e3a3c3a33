#include "dataset/export/packets/ouster_packets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/units.h"
#include "dataset/export/packets/capture_writer.h"
#include "dataset/export/packets/pulse_grid.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/dataset_description.h"
#include "dataset/import/scans/ouster_sheet.h"
#include "dataset/import/scans/packet_bytes.h"

namespace tera {
namespace {

using Json = nlohmann::json;

/// Modes of the units: columns of a turn, and turns per second.
constexpr std::array<std::pair<int, double>, 6> kModes = {
    {{512, 10}, {512, 20}, {1024, 10}, {1024, 20}, {2048, 10}, {4096, 5}}};
constexpr std::array<std::size_t, 3> kBeams = {32, 64, 128};

/// "OS-1-128": the family by the field of view, of 90, 42.4 and 22.5 degrees.
std::string ProductOf(const LidarPattern& pattern) {
  constexpr double kLeastOfOs0_deg = 66, kLeastOfOs1_deg = 32;
  const double field_deg = pattern.elevation_deg.front() - pattern.elevation_deg.back();
  const int family = field_deg > kLeastOfOs0_deg ? 0 : field_deg > kLeastOfOs1_deg ? 1 : 2;
  return fmt::format("OS-{}-{}", family, pattern.rings());
}

OusterSheet SheetOf(const LidarPattern& pattern, std::uint64_t serial) {
  OusterSheet sheet;
  sheet.product = ProductOf(pattern);
  sheet.serial = serial;
  sheet.profile = pattern.returns == 2 ? "RNG19_RFL8_SIG16_NIR16_DUAL" : "RNG19_RFL8_SIG16_NIR16";
  sheet.pixel = *OusterPixelOf(sheet.profile);
  sheet.columns_per_frame = pattern.columns;
  sheet.beams = static_cast<int>(pattern.rings());
  sheet.last_column = pattern.columns - 1;
  sheet.rate_hz = pattern.rate_hz;
  return sheet;
}

/// The metadata in the form of firmware 3.
std::string MetadataOf(const OusterSheet& sheet, const LidarPattern& pattern) {
  const Json as_they_are = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Json turned = {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::vector<double> azimuths_deg;
  std::vector<int> shifts_px;
  constexpr double kTurn_deg = 360;
  for (const double offset_deg : pattern.azimuth_offset_deg) {
    azimuths_deg.push_back(0.0 - offset_deg);
    shifts_px.push_back(static_cast<int>(std::lround(-offset_deg / kTurn_deg * pattern.columns)));
  }
  const Json metadata = {{"beam_intrinsics",
                          {{"beam_altitude_angles", pattern.elevation_deg},
                           {"beam_azimuth_angles", azimuths_deg},
                           {"beam_to_lidar_transform", as_they_are},
                           {"lidar_origin_to_beam_origin_mm", 0}}},
                         {"calibration_status", {{"reflectivity", {{"valid", true}}}}},
                         {"config_params",
                          {{"azimuth_window", {0, 360000}},
                           {"columns_per_packet", sheet.columns_per_packet},
                           {"lidar_mode", fmt::format("{}x{:g}", pattern.columns, pattern.rate_hz)},
                           {"operating_mode", "NORMAL"},
                           {"timestamp_mode", "TIME_FROM_PTP_1588"},
                           {"udp_port_lidar", sheet.port},
                           {"udp_profile_imu", "LEGACY"},
                           {"udp_profile_lidar", sheet.profile}}},
                         {"imu_intrinsics", {{"imu_to_sensor_transform", as_they_are}}},
                         {"lidar_data_format",
                          {{"column_window", {sheet.first_column, sheet.last_column}},
                           {"columns_per_frame", sheet.columns_per_frame},
                           {"columns_per_packet", sheet.columns_per_packet},
                           {"pixel_shift_by_row", shifts_px},
                           {"pixels_per_column", sheet.beams},
                           {"udp_profile_imu", "LEGACY"},
                           {"udp_profile_lidar", sheet.profile}}},
                         {"lidar_intrinsics", {{"lidar_to_sensor_transform", turned}}},
                         {"sensor_info",
                          {{"build_rev", fmt::format("tera {}", TeraVersion())},
                           {"image_rev", ""},
                           {"initialization_id", 0},
                           {"prod_line", sheet.product},
                           {"prod_sn", std::to_string(sheet.serial)},
                           {"status", "RUNNING"}}}};
  return metadata.dump(2) + "\n";
}

class OusterWriter : public PacketWriter {
 public:
  OusterWriter(LidarPattern pattern, std::uint64_t serial, std::filesystem::path file)
      : pattern_(std::move(pattern)),
        sheet_(SheetOf(pattern_, serial)),
        metadata_(std::filesystem::path(file) += ".json"),
        capture_(file += ".pcap", static_cast<std::uint16_t>(sheet_.port)) {
    metadata_.Append(MetadataOf(sheet_, pattern_));
  }

  void Take(const LidarScan& scan, TimeNs start_ns, const std::string& place) override {
    const RangeSteps ranges{sheet_.pixel.range_step_m, sheet_.pixel.range_mask};
    const PulseGrid grid(scan, pattern_, ranges, place);
    for (int first = 0; first < pattern_.columns; first += sheet_.columns_per_packet) {
      std::string packet = Head();
      for (int column = first; column < first + sheet_.columns_per_packet; ++column) {
        PutColumn(grid, column, start_ns + pattern_.ColumnStart(column), &packet);
      }
      capture_.Add(start_ns + pattern_.ColumnStart(first + sheet_.columns_per_packet), packet);
    }
    ++frame_;
  }

  void Finish() override {
    metadata_.Commit();
    capture_.Commit();
  }

 private:
  std::string Head() const {
    constexpr std::uint16_t kLidarPacket = 1;
    constexpr std::size_t kFrameAt = 2, kSerialAt = 7;
    std::string packet(sheet_.packet_bytes(), '\0');
    PutPacketNumber(kLidarPacket, 0, &packet);
    PutPacketNumber(frame_, kFrameAt, &packet);
    PutPacketNumber(static_cast<std::uint32_t>(sheet_.serial), kSerialAt, &packet);
    return packet;
  }

  void PutColumn(const PulseGrid& grid, int column, TimeNs t_ns, std::string* packet) const {
    constexpr std::size_t kNumberAt = 8, kStatusAt = 10;
    constexpr std::uint16_t kIsValid = 1;
    const auto in_packet = static_cast<std::size_t>(column % sheet_.columns_per_packet);
    const std::size_t at = kOusterPacketHead + in_packet * sheet_.column_bytes();
    PutPacketNumber(static_cast<std::uint64_t>(t_ns), at, packet);
    PutPacketNumber(static_cast<std::uint16_t>(column), at + kNumberAt, packet);
    PutPacketNumber(kIsValid, at + kStatusAt, packet);
    for (std::size_t ring = 0; ring < pattern_.rings(); ++ring) {
      const std::size_t pixel_at = at + kOusterColumnHead + ring * sheet_.pixel.bytes;
      for (std::size_t n = 0; n < sheet_.pixel.returns.size(); ++n) {
        const PacketReturn& one = grid.At(column, ring)[n];
        const OusterPixel::Return& places = sheet_.pixel.returns[n];
        PutPacketNumber(one.steps, pixel_at + places.range_at, packet);
        PutPacketNumber(one.reflectivity, pixel_at + places.reflectivity_at, packet);
      }
    }
  }

  const LidarPattern pattern_;
  const OusterSheet sheet_;
  CheckedFile metadata_;
  CaptureWriter capture_;
  std::uint16_t frame_ = 0;
};

}  // namespace

std::string WhyNotOuster(const LidarPattern& pattern) {
  if (std::find(kBeams.begin(), kBeams.end(), pattern.rings()) == kBeams.end()) {
    return fmt::format("elevation_deg has {} beams, need 32, 64 or 128", pattern.rings());
  }
  if (!std::is_sorted(pattern.elevation_deg.rbegin(), pattern.elevation_deg.rend(),
                      std::less_equal<>())) {
    return "elevation_deg does not fall from ring to ring";
  }
  const auto fires_later = [](double offset_us) { return offset_us != 0; };
  if (std::any_of(pattern.firing_us.begin(), pattern.firing_us.end(), fires_later)) {
    return "firing_offset_us is not 0 for all beams";
  }
  if (!pattern.is_clockwise) return "clockwise is false, need true";
  const std::pair mode(pattern.columns, pattern.rate_hz);
  if (std::find(kModes.begin(), kModes.end(), mode) == kModes.end()) {
    return fmt::format(
        "columns is {} at {:g} Hz, need 512x10, 512x20, 1024x10, 1024x20, 2048x10 or 4096x5",
        pattern.columns, pattern.rate_hz);
  }
  if (pattern.returns > 2) return fmt::format("returns is {}, need 1 or 2", pattern.returns);
  return "";
}

std::unique_ptr<PacketWriter> MakeOusterWriter(const LidarPattern& pattern, std::uint64_t serial,
                                               const std::filesystem::path& file) {
  return std::make_unique<OusterWriter>(pattern, serial, file);
}

}  // namespace tera
