#include "dataset/import/scans/capture_file.h"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <cerrno>
#include <fstream>
#include <memory>
#include <optional>

#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

using Capture = std::unique_ptr<pcap_t, decltype(&pcap_close)>;

Capture OpenCapture(const std::filesystem::path& file) {
  if (!std::ifstream(file)) FailFile(file, "reading", errno);
  char why[PCAP_ERRBUF_SIZE] = "";
  Capture capture(
      pcap_open_offline_with_tstamp_precision(file.c_str(), PCAP_TSTAMP_PRECISION_NANO, why),
      &pcap_close);
  if (!capture) {
    throw InputError(
        file.string(),
        {FaultKind::kMalformed,
         fmt::format(
             "is not a network capture ({}); need a pcap or pcapng file, or the topic of a bag",
             why)});
  }
  return capture;
}

/// Reads a number in network byte order.
std::uint32_t BigEndian(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < count; ++k) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  }
  return value;
}

constexpr std::uint32_t kIpv4 = 0x0800, kIpv6 = 0x86dd;

/// The IP packet in a link-layer frame; empty if there is none.
std::string_view InternetOf(int link, std::string_view frame) {
  constexpr std::size_t kEthernetType = 12, kTypeBytes = 2, kTagBytes = 4;
  constexpr std::size_t kCooked = 16, kCooked2 = 20, kLoopback = 4;
  constexpr std::uint32_t kVlan = 0x8100, kServiceVlan = 0x88a8;
  const auto behind = [&](std::size_t head) {
    return frame.size() > head ? frame.substr(head) : std::string_view();
  };
  if (link == DLT_RAW || link == DLT_IPV4 || link == DLT_IPV6) return frame;
  if (link == DLT_NULL || link == DLT_LOOP) return behind(kLoopback);
  if (link == DLT_LINUX_SLL) return behind(kCooked);
  if (link == DLT_LINUX_SLL2) return behind(kCooked2);
  if (link != DLT_EN10MB) return {};
  for (std::size_t at = kEthernetType; at + kTypeBytes < frame.size(); at += kTagBytes) {
    const std::uint32_t type = BigEndian(frame, at, kTypeBytes);
    if (type == kIpv4 || type == kIpv6) return behind(at + kTypeBytes);
    if (type != kVlan && type != kServiceVlan) return {};
  }
  return {};
}

/// UDP payload of an IP packet: a whole datagram or a fragment.
struct Carried {
  std::string_view bytes;
  bool is_fragment = false, is_last = true;
  std::size_t offset = 0;
  std::string key;  ///< identifies the datagram that a fragment belongs to
};

std::optional<Carried> UdpOf(std::string_view packet) {
  constexpr std::size_t kHead4 = 20, kHead6 = 40;
  constexpr std::uint32_t kUdp = 17, kMoreFragments = 0x2000, kOffsetMask = 0x1fff;
  if (packet.empty()) return std::nullopt;
  const int version = static_cast<unsigned char>(packet[0]) >> 4;
  if (version == 6) {
    if (packet.size() < kHead6 || BigEndian(packet, 6, 1) != kUdp) return std::nullopt;
    return Carried{.bytes = packet.substr(kHead6)};
  }
  if (version != 4 || packet.size() < kHead4 || BigEndian(packet, 9, 1) != kUdp) {
    return std::nullopt;
  }
  const std::size_t head = 4 * (BigEndian(packet, 0, 1) & 0xF);
  const std::size_t total = BigEndian(packet, 2, 2);
  // The length field may be 0 if the network card segments packets.
  const std::size_t end = total == 0 ? packet.size() : std::min(total, packet.size());
  if (head < kHead4 || head > end) return std::nullopt;
  const std::uint32_t flags = BigEndian(packet, 6, 2);
  const bool more = (flags & kMoreFragments) != 0;
  const std::size_t offset = std::size_t{8} * (flags & kOffsetMask);
  return Carried{packet.substr(head, end - head), more || offset > 0, !more, offset,
                 std::string(packet.substr(12, 8)) + std::string(packet.substr(4, 2))};
}

/// Reassembles datagrams from fragments in any order.
class Fragments {
 public:
  /// Adds a fragment. Returns the datagram if it is complete.
  std::optional<std::string> Add(const Carried& carried) {
    if (pending_.size() > kMostPending) pending_.erase(pending_.begin());
    Pending& pending = pending_[carried.key];
    if (pending.bytes.size() < carried.offset + carried.bytes.size()) {
      pending.bytes.resize(carried.offset + carried.bytes.size());
    }
    pending.bytes.replace(carried.offset, carried.bytes.size(), carried.bytes);
    pending.have += carried.bytes.size();
    if (carried.is_last) pending.need = carried.offset + carried.bytes.size();
    if (pending.need == 0 || pending.have < pending.need) return std::nullopt;
    std::string whole = std::move(pending.bytes);
    pending_.erase(carried.key);
    return whole;
  }

 private:
  static constexpr std::size_t kMostPending = 64;
  struct Pending {
    std::string bytes;
    std::size_t have = 0, need = 0;
  };
  std::map<std::string, Pending> pending_;
};

struct Datagram {
  int port = 0;
  std::string_view bytes;
  bool is_cut = false;  ///< the capture does not contain all of its bytes
};

std::optional<Datagram> DatagramOf(std::string_view udp) {
  constexpr std::size_t kHead = 8;
  if (udp.size() < kHead) return std::nullopt;
  const std::size_t length = BigEndian(udp, 4, 2);
  const bool is_cut = length > udp.size();
  const std::size_t end = length < kHead || is_cut ? udp.size() : length;
  return Datagram{static_cast<int>(BigEndian(udp, 2, 2)), udp.substr(kHead, end - kHead), is_cut};
}

/// Iterates over a capture.
class CaptureReader {
 public:
  explicit CaptureReader(const std::filesystem::path& file)
      : file_(file), capture_(OpenCapture(file)), link_(pcap_datalink(capture_.get())) {
    if (!IsKnownLink()) {
      const char* name = pcap_datalink_val_to_name(link_);
      throw InputError(file.string(),
                       {FaultKind::kUnsupported,
                        fmt::format("was captured on a link of the type {}; need Ethernet, "
                                    "loopback, Linux's cooked form or raw IP",
                                    name == nullptr ? std::to_string(link_) : name)});
    }
  }

  /// The next UDP datagram; nullopt at the end. Its bytes stay valid until the next call.
  std::optional<Datagram> Next() {
    pcap_pkthdr* head = nullptr;
    const u_char* data = nullptr;
    for (int status = pcap_next_ex(capture_.get(), &head, &data); status != PCAP_ERROR_BREAK;
         status = pcap_next_ex(capture_.get(), &head, &data)) {
      if (status != 1) {
        throw InputError(Place(), {FaultKind::kMalformed,
                                   fmt::format("cut off or damaged behind it ({}); copy the file "
                                               "again",
                                               pcap_geterr(capture_.get()))});
      }
      ++number_;
      received_ns_ = TimeNs{head->ts.tv_sec} * kNsPerSecond + head->ts.tv_usec;
      const std::string_view frame(reinterpret_cast<const char*>(data), head->caplen);
      const auto carried = UdpOf(InternetOf(link_, frame));
      if (!carried) continue;
      if (carried->is_fragment) {
        const auto whole = fragments_.Add(*carried);
        if (!whole) continue;
        whole_ = *whole;
      }
      const auto datagram =
          DatagramOf(carried->is_fragment ? std::string_view(whole_) : carried->bytes);
      if (datagram) return datagram;
    }
    return std::nullopt;
  }

  std::string Place() const { return fmt::format("{}: packet {}", file_.string(), number_); }
  std::int64_t number() const { return number_; }
  TimeNs received_ns() const { return received_ns_; }

 private:
  bool IsKnownLink() const {
    for (const int known : {DLT_EN10MB, DLT_RAW, DLT_IPV4, DLT_IPV6, DLT_NULL, DLT_LOOP,
                            DLT_LINUX_SLL, DLT_LINUX_SLL2}) {
      if (link_ == known) return true;
    }
    return false;
  }

  std::filesystem::path file_;
  Capture capture_;
  int link_;
  Fragments fragments_;
  std::string whole_;
  std::int64_t number_ = 0;
  TimeNs received_ns_ = 0;
};

std::string PortsText(const PortCounts& ports) {
  constexpr int kMost = 8;
  std::string text;
  int told = 0;
  for (const auto& [port, count] : ports) {
    if (told++ == kMost) return text + ", ...";
    text += fmt::format("{}{} ({} packets)", told == 1 ? "" : ", ", port, count);
  }
  return text.empty() ? "it holds no UDP at all" : "it holds UDP to " + text;
}

}  // namespace

void ReadCapture(const std::filesystem::path& file, int port, const LeaveOut& leave_out,
                 const TakePacket& take) {
  CaptureReader reader(file);
  PortCounts others;
  bool any = false;
  const auto next = [&]() -> std::optional<Datagram> {
    try {
      return reader.Next();
    } catch (const InputError& cut) {
      leave_out(cut);
      return std::nullopt;
    }
  };
  while (const auto datagram = next()) {
    if (datagram->port != port) {
      ++others[datagram->port];
      continue;
    }
    any = true;
    const UnitPacket packet{reader.received_ns(), datagram->bytes, reader.Place()};
    try {
      if (datagram->is_cut) {
        RefusePacket(packet,
                     "the capture holds only its beginning; capture whole packets (tcpdump -s 0), "
                     "or skip such packets with --skip-bad-rows");
      }
      take(packet);
    } catch (const InputError& fault) {
      leave_out(fault);
    }
  }
  if (any) return;
  throw InputError(file.string(),
                   {FaultKind::kMissing,
                    fmt::format("holds no packets of a lidar to the UDP port {}; {}; name the "
                                "lidar's by 'port'",
                                port, PortsText(others))});
}

bool LooksLikeCapture(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t kMagicBytes = 4;
  char first[24] = {};  // the header of a pcap file
  stream.read(first, sizeof first);
  if (!stream) return false;
  const std::string_view magic(first, kMagicBytes);
  for (const std::string_view known : {"\xd4\xc3\xb2\xa1", "\xa1\xb2\xc3\xd4", "\x4d\x3c\xb2\xa1",
                                       "\xa1\xb2\x3c\x4d", "\x0a\x0d\x0d\x0a"}) {
    if (magic == known) return true;
  }
  return false;
}

PortCounts PortsOfCapture(const std::filesystem::path& file, std::int64_t most_packets) {
  CaptureReader reader(file);
  PortCounts ports;
  while (reader.number() < most_packets) {
    const auto datagram = reader.Next();
    if (!datagram) break;
    ++ports[datagram->port];
  }
  return ports;
}

}  // namespace tera
