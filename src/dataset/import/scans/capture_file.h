#pragma once

#include <filesystem>
#include <map>

#include "dataset/import/scans/unit_packet.h"

namespace tera {

/// Number of datagrams for each destination port.
using PortCounts = std::map<int, std::int64_t>;

/// Passes the UDP datagrams to one port of a network capture to `take`, with one in memory at a
/// time.
///
/// Model   pcap and pcapng of Ethernet (with VLAN tags), Linux's cooked forms, loopback and raw IP;
///         IPv4 and IPv6. Fragments of IPv4 are joined. A datagram that lacks a fragment is
///         dropped, as the receiver's system would.
/// Omits   fragments of IPv6, tunnels, checksums.
/// Throws  InputError where the file is no such capture. A file that ends within a packet goes to
///         `leave_out`. A port without datagrams is a fault, which names the ports that have some.
void ReadCapture(const std::filesystem::path& file, int port, const LeaveOut& leave_out,
                 const TakePacket& take);

/// Whether the file's first bytes are those of a capture.
bool LooksLikeCapture(const std::filesystem::path& file);

/// Datagrams for each port among the first `most_packets` packets.
PortCounts PortsOfCapture(const std::filesystem::path& file, std::int64_t most_packets);

}  // namespace tera
