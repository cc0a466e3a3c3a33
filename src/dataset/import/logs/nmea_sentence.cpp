#include "dataset/import/logs/nmea_sentence.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>

namespace tera {
namespace {

unsigned ByteAt(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// UBX: b5 62, class, id, 16-bit length, payload, two checksum bytes.
std::size_t UbxFrameBytes(std::string_view bytes) {
  constexpr std::size_t kHead = 6, kSums = 2, kSummedFrom = 2;
  if (bytes.size() < kHead + kSums || !bytes.starts_with("\xb5\x62")) return 0;
  const std::size_t length = ByteAt(bytes, 4) | ByteAt(bytes, 5) << 8;
  if (bytes.size() < kHead + length + kSums) return 0;
  unsigned a = 0, b = 0;
  for (std::size_t k = kSummedFrom; k < kHead + length; ++k) {
    a = (a + ByteAt(bytes, k)) & 0xff;
    b = (b + a) & 0xff;
  }
  const std::size_t end = kHead + length;
  return ByteAt(bytes, end) == a && ByteAt(bytes, end + 1) == b ? end + kSums : 0;
}

/// RTCM 3: d3, six zero bits, 10-bit length, payload, CRC-24Q.
std::size_t RtcmFrameBytes(std::string_view bytes) {
  constexpr std::size_t kHead = 3, kCrc = 3;
  constexpr std::uint32_t kPolynomial = 0x1864cfb, kTopBit = 0x1000000;
  if (bytes.size() < kHead + kCrc || ByteAt(bytes, 0) != 0xd3 || ByteAt(bytes, 1) > 3) return 0;
  const std::size_t end = kHead + (ByteAt(bytes, 1) << 8 | ByteAt(bytes, 2));
  if (bytes.size() < end + kCrc) return 0;
  std::uint32_t crc = 0;
  for (std::size_t k = 0; k < end; ++k) {
    crc ^= ByteAt(bytes, k) << 16;
    for (int bit = 0; bit < 8; ++bit) {
      crc <<= 1;
      if ((crc & kTopBit) != 0) crc ^= kPolynomial;
    }
  }
  const std::uint32_t told =
      ByteAt(bytes, end) << 16 | ByteAt(bytes, end + 1) << 8 | ByteAt(bytes, end + 2);
  return told == crc ? end + kCrc : 0;
}

bool IsAlphanumeric(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// True if the body begins like a sentence of a receiver, such as "GNGGA" or "PTNL".
bool IsOfReceiver(std::string_view body) {
  constexpr std::array<std::string_view, 14> kKinds = {"GGA", "RMC", "GNS", "GST", "ZDA",
                                                       "VTG", "HDT", "GSV", "GSA", "GLL",
                                                       "GBS", "THS", "GGK", "TXT"};
  const std::string_view head = body.substr(0, body.find(','));
  if (head.size() == body.size()) return false;
  if (head == "PTNL" || head == "PUBX") return true;
  return head.size() == 5 &&
         std::find(kKinds.begin(), kKinds.end(), head.substr(2)) != kKinds.end();
}

}  // namespace

std::optional<NmeaSentence> SentenceIn(std::string_view line) {
  const std::size_t begin = line.find('$');
  const auto is_text = [](char c) { return (c >= ' ' && c <= '~') || c == '\t'; };
  const std::string_view before = line.substr(0, begin);
  if (begin == std::string_view::npos || !std::all_of(before.begin(), before.end(), is_text)) {
    return std::nullopt;
  }
  const std::string_view sentence = line.substr(begin + 1);
  const std::size_t star = sentence.find('*');
  if (star == std::string_view::npos) {
    return begin == 0 ? std::optional(NmeaSentence{sentence}) : std::nullopt;
  }
  unsigned sum = 0, told = 0;
  for (const char c : sentence.substr(0, star)) sum ^= static_cast<unsigned char>(c);
  const std::string_view digits = sentence.substr(star + 1, 2), rest = sentence.substr(star + 1);
  const auto [stop, status] =
      std::from_chars(digits.data(), digits.data() + digits.size(), told, 16);
  const bool is_told = digits.size() == 2 && status == std::errc() && stop == digits.data() + 2 &&
                       (rest.size() == 2 || !IsAlphanumeric(rest[2]));
  return NmeaSentence{sentence.substr(0, star), is_told && told == sum};
}

std::size_t BinaryFrameBytes(std::string_view bytes) {
  if (const std::size_t ubx = UbxFrameBytes(bytes)) return ubx;
  return RtcmFrameBytes(bytes);
}

bool BeginsAsNmea(std::string_view bytes) {
  std::size_t sentences = 0, others = 0;
  while (!bytes.empty()) {
    if (const std::size_t frame = BinaryFrameBytes(bytes)) {
      bytes.remove_prefix(frame);
      continue;
    }
    const std::size_t end = bytes.find('\n');
    const bool is_cut = end == std::string_view::npos;
    const std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(is_cut ? bytes.size() : end + 1);
    if (line.empty() || line == "\r" || line.front() == '#') continue;
    const auto sentence = SentenceIn(line);
    const bool is_one = sentence && IsOfReceiver(sentence->body);
    if (is_one || !is_cut) ++(is_one ? sentences : others);
  }
  return sentences > 0 && sentences >= others;
}

}  // namespace tera
