#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/time.h"

namespace tera {

/// One datagram of a lidar, from a capture or a bag.
struct UnitPacket {
  TimeNs received_ns = 0;  ///< by the clock of the computer that received it
  std::string_view bytes;  ///< payload, without network headers
  std::string place;       ///< "drive.pcap: packet 12"
};

using TakePacket = std::function<void(const UnitPacket& packet)>;

/// Throws InputError for a packet that violates its format.
[[noreturn]] inline void RefusePacket(const UnitPacket& packet, const std::string& finding,
                                      FaultKind kind = FaultKind::kMalformed) {
  throw InputError(packet.place, {kind, finding});
}
inline constexpr const char* kOrLeaveOut = "; leave such packets out by --skip-bad-rows";

/// Handler of tolerable faults: counts and drops them if the user asks, else throws them.
using LeaveOut = std::function<void(const InputError& fault)>;

}  // namespace tera
