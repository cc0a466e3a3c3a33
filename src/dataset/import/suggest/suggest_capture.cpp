#include <fmt/format.h>

#include "core/error.h"
#include "dataset/import/scans/capture_file.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/suggest.h"

// Suggests a mapping for a network capture.

namespace tera {
namespace {

constexpr std::int64_t kLookedAt = 5000;  ///< number of packets examined
constexpr int kOusterPort = 7502, kVelodynePort = 2368;

/// Name of the lidar model for the mapping, from the first packet to kVelodynePort.
std::string UnitOfPacket(std::string_view bytes) {
  constexpr std::size_t kVelodyneBytes = 1206, kLeastPandar = 1068, kMostPandar = 1072;
  if (bytes.size() == kVelodyneBytes && bytes.back() == 0x22) return "vlp16";
  if (bytes.size() == kVelodyneBytes && bytes.back() == 0x28) return "vlp32c";
  const bool is_pandar = bytes.size() >= kLeastPandar && bytes.size() <= kMostPandar &&
                         bytes.starts_with("\xee\xff") && bytes[6] == 64;
  return is_pandar ? "qt64" : "unknown";
}

std::string FirstUnit(const std::filesystem::path& log) {
  /// Thrown to stop the reading.
  struct Enough {};
  std::string unit = "unknown";
  try {
    ReadCapture(
        log, kVelodynePort, [](const InputError&) {},
        [&](const UnitPacket& packet) {
          unit = UnitOfPacket(packet.bytes);
          throw Enough();
        });
  } catch (const Enough&) {
  }
  return unit;
}

}  // namespace

std::string SuggestForCapture(const std::filesystem::path& log) {
  const PortCounts ports = PortsOfCapture(log, kLookedAt);
  std::string lidars, others;
  for (const auto& [port, count] : ports) {
    if (port == kOusterPort) {
      lidars +=
          "  - {name: lidar_ouster, metadata: unknown}   # need the metadata JSON of the sensor\n";
    } else if (port == kVelodynePort) {
      const std::string unit = FirstUnit(log);
      lidars += fmt::format(
          "  - {{name: lidar, unit: {}}}   # {}\n", unit,
          unit == "unknown" ? "need vlp16, vlp32c or qt64" : "guessed: by its first packet");
    } else {
      others += fmt::format("#   UDP to port {}: {} of the first packets\n", port, count);
    }
  }
  if (lidars.empty()) {
    throw InputError(
        log.string(),
        {FaultKind::kMissing,
         fmt::format("is a network capture without UDP to 7502 (Ouster) or 2368 (Velodyne, Hesai); "
                     "name the lidar's 'port' in your own mapping\n{}",
                     others)});
  }
  return fmt::format(
             "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
             "name: {}\nmachine: machine   # guessed: name the machine's folder\nfile: {}\n"
             "zero: start\nlidars:\n",
             PlainNameOf(log.stem().string()), YamlWord(log.string())) +
         lidars + (others.empty() ? "" : "# Not mapped:\n" + others);
}

}  // namespace tera
