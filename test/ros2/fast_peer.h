#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A message received over the network: encapsulation and CDR.
using Payload = std::vector<std::uint8_t>;

/// Discovery's description of a published topic.
struct OfferedTopic {
  std::string type;
  bool reliable = false;
  bool transient_local = false;
  bool operator==(const OfferedTopic&) const = default;
};

/// Another participant in Fast DDS, which shares no code with TERA's, in place of a ROS 2 node on
/// this host. It uses the loopback interface alone.
class FastPeer {
 public:
  explicit FastPeer(int domain_id);
  ~FastPeer();

  /// Names of topics and types in DDS: "rt/clock", "rosgraph_msgs::msg::dds_::Clock_".
  struct Wish {
    std::string topic, type;
    bool reliable = false;
    bool transient_local = false;
  };
  void Subscribe(const Wish& wish);

  /// The next message of `topic` that `accept` admits; earlier ones are discarded. Nothing after a
  /// timeout far beyond the needs of a busy machine.
  std::optional<Payload> Next(
      const std::string& topic,
      const std::function<bool(const Payload&)>& accept = [](const Payload&) { return true; });
  /// Unrequested messages.
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

/// A domain of this process alone: the first of 1 to 100 whose lock it gets. Their ports, 7400 +
/// 250 for each domain, end below 32768, where the system's ephemeral ports begin.
int OwnDomainId();

}  // namespace tera
