#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/time.h"

namespace tera {

/// A datagram of a lidar, from a capture or a bag.
struct UnitPacket {
  TimeNs received_ns = 0;  ///< clock of the receiving computer
  std::string_view bytes;  ///< payload, without network headers
  std::string place;       ///< place for messages, such as "drive.pcap: packet 12"
};

using TakePacket = std::function<void(const UnitPacket& packet)>;

/// Throws InputError for a packet that violates the format.
[[noreturn]] inline void RefusePacket(const UnitPacket& packet, const std::string& finding,
                                      FaultKind kind = FaultKind::kMalformed) {
  throw InputError(packet.place, {kind, finding});
}
inline constexpr const char* kOrLeaveOut = "; skip such packets with --skip-bad-rows";

/// Handles a fault that affects a single packet: counts and skips it if the user allows that, and
/// otherwise throws it.
using LeaveOut = std::function<void(const InputError& fault)>;

}  // namespace tera
