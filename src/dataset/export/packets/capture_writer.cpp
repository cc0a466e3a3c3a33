#include "dataset/export/packets/capture_writer.h"

#include <cerrno>
#include <cstdio>
#include <string>

namespace tera {
namespace {

constexpr int kSnapLength = 262144;
constexpr std::size_t kIpHead = 20, kUdpHead = 8;
/// A multiple of 8, the unit of fragments' offsets: Ethernet's 1500 bytes less the IP header.
constexpr std::size_t kMostPart = 1480;

/// Appends a number in network byte order.
void AppendBig(std::uint16_t value, std::string* bytes) {
  bytes->push_back(static_cast<char>(value >> 8));
  bytes->push_back(static_cast<char>(value & 0xff));
}

/// The ones' complement sum of an IP header (RFC 1071).
std::uint16_t ChecksumOf(std::string_view head) {
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k + 1 < head.size(); k += 2) {
    sum += static_cast<unsigned char>(head[k]) << 8 | static_cast<unsigned char>(head[k + 1]);
  }
  while (sum > 0xffff) sum = (sum & 0xffff) + (sum >> 16);
  return static_cast<std::uint16_t>(~sum);
}

}  // namespace

CaptureWriter::CaptureWriter(const std::filesystem::path& file, std::uint16_t port)
    : file_(file),
      port_(port),
      link_(pcap_open_dead(DLT_EN10MB, kSnapLength), &pcap_close),
      dump_(pcap_dump_open(link_.get(), file_.temporary().c_str()), &pcap_dump_close) {
  if (!dump_) FailFile(file, "writing", errno);
}

void CaptureWriter::Add(TimeNs sent_ns, std::string_view payload) {
  std::string datagram;
  AppendBig(port_, &datagram);
  AppendBig(port_, &datagram);
  AppendBig(static_cast<std::uint16_t>(kUdpHead + payload.size()), &datagram);
  AppendBig(0, &datagram);
  datagram += payload;
  for (std::size_t at = 0; at < datagram.size(); at += kMostPart) {
    AddFrame(sent_ns, at, std::string_view(datagram).substr(at, kMostPart),
             at + kMostPart >= datagram.size());
  }
  ++datagrams_;
  RequireWritten();
}

void CaptureWriter::AddFrame(TimeNs sent_ns, std::size_t offset, std::string_view part,
                             bool is_last) {
  constexpr std::uint16_t kIpv4 = 0x0800, kVersionAndHead = 0x4500, kMoreFragments = 0x2000,
                          kHopsAndUdp = 0x4011;
  std::string ip;
  AppendBig(kVersionAndHead, &ip);
  AppendBig(static_cast<std::uint16_t>(kIpHead + part.size()), &ip);
  AppendBig(datagrams_, &ip);
  AppendBig(static_cast<std::uint16_t>(offset / 8 | (is_last ? 0 : kMoreFragments)), &ip);
  AppendBig(kHopsAndUdp, &ip);
  const std::size_t checksum_at = ip.size();
  ip += std::string("\xc0\xa8\x01\xc9\xff\xff\xff\xff");  // 192.168.1.201 to all
  std::string checksum;
  AppendBig(ChecksumOf(ip), &checksum);
  ip.insert(checksum_at, checksum);
  std::string frame = std::string(6, '\xff') + "\x02" + std::string(4, '\0') + "\x01";
  AppendBig(kIpv4, &frame);
  frame.append(ip).append(part);
  pcap_pkthdr head = {};
  head.ts.tv_sec = sent_ns / kNsPerSecond;
  head.ts.tv_usec = sent_ns % kNsPerSecond / 1000;
  head.caplen = head.len = static_cast<bpf_u_int32>(frame.size());
  pcap_dump(reinterpret_cast<u_char*>(dump_.get()), &head,
            reinterpret_cast<const u_char*>(frame.data()));
}

void CaptureWriter::RequireWritten() {
  if (std::ferror(pcap_dump_file(dump_.get())) != 0) FailFile(file_.path(), "writing", errno);
}

void CaptureWriter::Commit() {
  if (pcap_dump_flush(dump_.get()) != 0) FailFile(file_.path(), "writing", errno);
  dump_.reset();
  file_.Commit();
}

}  // namespace tera
