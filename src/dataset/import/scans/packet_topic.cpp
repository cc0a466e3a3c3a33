#include "dataset/import/scans/packet_topic.h"

#include <fmt/format.h>

#include "core/error.h"
#include "dataset/import/bag/topic_table.h"
#include "dataset/import/scans/message_cursor.h"

namespace tera {
namespace {

/// Size of the array `data` of a packet.
constexpr std::size_t kVelodyneBytes = 1206, kPandarBytes = 1500;

bool IsOuster(std::string_view type) {
  return type == kOusterType || type == kOusterMsgsType || type == kOusterSensorType;
}

class MessageVisitor : public BagVisitor {
 public:
  MessageVisitor(const std::filesystem::path& bag, const BagTopic& topic, const LeaveOut& leave_out,
                 const TakeMessage& take)
      : bag_(bag), topic_(topic), leave_out_(leave_out), take_(take) {}

  Wish Wants(const BagTopic& topic) override {
    return topic.name == topic_.name ? Wish::kTake : Wish::kSkip;
  }

  bool Take(std::size_t, const BagMessage& message) override {
    const std::string place = MessagePlace(bag_, topic_, ++number_);
    try {
      take_(message, place);
    } catch (const BadBytes& bad) {
      leave_out_(InputError(
          place, {FaultKind::kMalformed,
                  bad.finding + "; repair it, or skip such messages with --skip-bad-rows"}));
    } catch (const InputError& fault) {
      leave_out_(fault);
    }
    return true;
  }

 private:
  const std::filesystem::path& bag_;
  const BagTopic& topic_;
  const LeaveOut& leave_out_;
  const TakeMessage& take_;
  int number_ = 0;
};

/// Reads a message that contains several packets with one stamp each.
void TakeScanMessage(const BagTopic& topic, const BagMessage& message, const std::string& place,
                     const LeaveOut& leave_out, const TakePacket& take) {
  const bool has_size = topic.type == kPandarType;
  const std::size_t bytes = has_size ? kPandarBytes : kVelodyneBytes;
  MessageCursor cursor(topic.message_encoding, message.bytes);
  cursor.HeaderStamp();
  const auto count = cursor.Number<std::uint32_t>();
  for (std::uint32_t k = 0; k < count; ++k) {
    UnitPacket packet{cursor.Time(), cursor.Bytes(bytes),
                      fmt::format("{} packet {}", place, k + 1)};
    if (has_size) {
      const auto size = cursor.Number<std::uint32_t>();
      if (size > bytes) {
        throw BadBytes{fmt::format("packet {} is said to have {} bytes of {}", k + 1, size, bytes)};
      }
      packet.bytes = packet.bytes.substr(0, size);
    }
    try {
      take(packet);
    } catch (const InputError& fault) {
      leave_out(fault);
    }
  }
}

}  // namespace

bool HoldsPackets(std::string_view type) {
  return type == kVelodyneType || type == kPandarType || IsOuster(type);
}

void ReadMessages(const std::filesystem::path& bag, const BagTopic& topic, UnpackedFiles* unpacked,
                  bool skips_bad, const LeaveOut& leave_out, const TakeMessage& take) {
  MessageVisitor visitor(bag, topic, leave_out, take);
  try {
    ReadBag(bag, unpacked, &visitor, /*to_the_damage=*/skips_bad);
  } catch (const BagDamage& damage) {
    leave_out(damage);
  }
}

void ReadPacketTopic(const std::filesystem::path& bag, const BagTopic& topic,
                     UnpackedFiles* unpacked, bool skips_bad, const LeaveOut& leave_out,
                     const TakePacket& take) {
  ReadMessages(bag, topic, unpacked, skips_bad, leave_out,
               [&](const BagMessage& message, const std::string& place) {
                 if (!IsOuster(topic.type)) {
                   TakeScanMessage(topic, message, place, leave_out, take);
                   return;
                 }
                 MessageCursor cursor(topic.message_encoding, message.bytes);
                 const auto count = cursor.Number<std::uint32_t>();
                 take({message.log_ns, cursor.Bytes(count), place});
               });
}

}  // namespace tera
