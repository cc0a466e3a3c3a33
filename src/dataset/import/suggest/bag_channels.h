#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dataset/import/bag/bag_source.h"
#include "dataset/import/suggest/topic_look.h"

/// Channels from a bag's topics, as texts of a mapping.

namespace tera {

struct SeenTopic {
  BagTopic topic;
  std::int64_t messages = 0;
  TimeNs first_ns = 0, last_ns = 0;  ///< recording times

  /// "100 messages, 10 Hz"
  std::string Rate() const;
};

/// Whether a message is one number, such as std_msgs/Float32.
bool IsNumber(const BagTopic& topic);

/// Each Add examines the messages and returns the reason why they form no channel, or an empty
/// text.
class BagChannels {
 public:
  BagChannels(const std::filesystem::path& log, UnpackedFiles* unpacked)
      : log_(log), unpacked_(unpacked) {}

  std::string AddImu(const SeenTopic& seen, TakenNames* names);
  std::string AddReceiver(const SeenTopic& seen, TakenNames* names);
  std::string AddJoints(const SeenTopic& seen, TakenNames* names);
  std::string AddPose(const SeenTopic& seen);
  /// TERA's own message: levers, and the pose of the tool as a table.
  std::string AddDeltaCan(const SeenTopic& seen, TakenNames* names);
  std::string AddToolPose(const SeenTopic& seen, TakenNames* names);
  /// A lever, an angle or a table of one column, by the topic's name.
  std::string AddNumber(const SeenTopic& seen, TakenNames* names);
  /// "odom>base_link 100, ..." for a topic of transforms.
  std::string PairsText(const SeenTopic& seen) const;
  /// `zero:`, `origin:` and all channels.
  std::string Yaml() const;

 private:
  /// A channel, whose time is chosen when all channels are known.
  struct Entry {
    std::string key;  ///< "imus"
    std::string head;
    TopicTimes times;
    RuleGuesses rules;
    std::string rest;
  };
  struct Lever {
    std::string name, topic;
    TopicTimes times;
    double largest = 0;
    std::string rate;
    RuleGuesses rules;
  };

  TopicLook Look(const SeenTopic& seen, const std::vector<std::string>& paths) const;
  void Add(const std::string& key, const SeenTopic& seen, const TopicTimes& times,
           const RuleGuesses& rules, const std::string& rest, TakenNames* names);
  std::string AddJointSet(const SeenTopic& seen, const std::vector<std::string>& joints,
                          TakenNames* names);
  /// The table of AddNumber's levers, and the latest of their first times.
  std::string CommandsYaml(bool trusts_far, TimeNs* first_ns) const;

  std::filesystem::path log_;
  UnpackedFiles* unpacked_;
  std::vector<Entry> entries_;
  std::vector<Lever> levers_;
  std::string origin_;
  bool has_commands_ = false;
};

}  // namespace tera
