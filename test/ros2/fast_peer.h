#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A message as it came over the network: encapsulation and CDR.
using Payload = std::vector<std::uint8_t>;

/// What discovery says of a topic that somebody publishes.
struct OfferedTopic {
  std::string type;
  bool reliable = false;
  bool transient_local = false;
  bool operator==(const OfferedTopic&) const = default;
};

/// Another participant, made with Fast DDS and sharing no code with TERA's: what a ROS 2 node on
/// this host would be. On the loopback interface alone.
class FastPeer {
 public:
  explicit FastPeer(int domain_id);
  ~FastPeer();

  /// Topics and types as they are in DDS: "rt/clock", "rosgraph_msgs::msg::dds_::Clock_".
  struct Wish {
    std::string topic, type;
    bool reliable = false;
    bool transient_local = false;
  };
  void Subscribe(const Wish& wish);

  /// The next message of `topic` that `accept` agrees to; those before it are gone. Nothing after
  /// a time far beyond what even a busy machine needs.
  std::optional<Payload> Next(
      const std::string& topic,
      const std::function<bool(const Payload&)>& accept = [](const Payload&) { return true; });
  /// Messages that have come and were not asked for.
  std::size_t Waiting(const std::string& topic) const;

  /// `topic` must then be Published with payloads of that type.
  void Advertise(const Wish& wish);
  void Publish(const std::string& topic, const Payload& payload);
  /// Waits until somebody reads it.
  bool WaitForReader(const std::string& topic);

  /// Waits until somebody offers it.
  std::optional<OfferedTopic> WaitForOffer(const std::string& topic);
  std::map<std::string, OfferedTopic> Offers() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A domain that no other test on this machine has while this process lives: the first of 1 to 100
/// of which it gets the lock. Their ports, 7400 + 250 a domain, end below 32768, from where on the
/// operating system hands ports out.
int OwnDomainId();

}  // namespace tera
