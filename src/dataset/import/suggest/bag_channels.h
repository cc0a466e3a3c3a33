#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dataset/import/bag/bag_source.h"
#include "dataset/import/suggest/topic_look.h"

/// Creates mapping text for channels from the topics of a bag.

namespace tera {

struct SeenTopic {
  BagTopic topic;
  std::int64_t messages = 0;
  TimeNs first_ns = 0, last_ns = 0;  ///< recording times

  /// Text such as "100 messages, 10 Hz".
  std::string Rate() const;
};

/// True if a message of the topic is a single number, such as std_msgs/Float32.
bool IsNumber(const BagTopic& topic);

/// Each Add function examines the messages of a topic and adds a channel. It returns the reason if
/// no channel is possible, and an empty text otherwise.
class BagChannels {
 public:
  BagChannels(const std::filesystem::path& log, UnpackedFiles* unpacked)
      : log_(log), unpacked_(unpacked) {}

  std::string AddImu(const SeenTopic& seen, TakenNames* names);
  std::string AddReceiver(const SeenTopic& seen, TakenNames* names);
  std::string AddJoints(const SeenTopic& seen, TakenNames* names);
  std::string AddPose(const SeenTopic& seen);
  /// TERA's own message DeltaCan gives levers, and a table with the pose of the tool.
  std::string AddDeltaCan(const SeenTopic& seen, TakenNames* names);
  std::string AddToolPose(const SeenTopic& seen, TakenNames* names);
  /// Adds a lever, an angle or a one-column table, depending on the topic's name.
  std::string AddNumber(const SeenTopic& seen, TakenNames* names);
  /// Text such as "odom>base_link 100, ..." with counts, for a topic of transforms.
  std::string PairsText(const SeenTopic& seen) const;
  /// The keys `zero` and `origin`, and all channels.
  std::string Yaml() const;

 private:
  /// A channel. Its time is chosen after all channels are known.
  struct Entry {
    std::string key;  ///< such as "imus"
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
  /// Table of all levers found by AddNumber. `first_ns` receives the latest of their first times.
  std::string CommandsYaml(bool trusts_far, TimeNs* first_ns) const;

  std::filesystem::path log_;
  UnpackedFiles* unpacked_;
  std::vector<Entry> entries_;
  std::vector<Lever> levers_;
  std::string origin_;
  bool has_commands_ = false;
};

}  // namespace tera
