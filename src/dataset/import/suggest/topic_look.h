#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/import/bag/topic_table.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Times of a topic's messages, and how regular they are.
struct TopicTimes {
  std::string stamp;  ///< path of the stamp within the message; empty if there is none
  TimeSteps own_steps, log_steps;
  std::int64_t unfilled = 0;  ///< number of stamps that are 0
  TimeNs first_own_ns = 0, first_log_ns = 0, last_log_ns = 0;
  std::vector<TimeNs> t_ns;  ///< message times: stamps if usable, otherwise recording times
  TimeNs ahead_ns = 0;       ///< recording time minus stamp of the first message

  /// True if the stamps are usable.
  bool HasStamps() const;
  /// True if the stamps come from a different clock than the recording times.
  bool IsFar() const;
};

/// Mapping text for the time of a channel.
struct TimeChoice {
  std::string yaml;  ///< line "time: {...}   # guessed: ..." without indentation, or empty
  TimeNs first_ns = 0;
};
/// Chooses stamps if usable, else recording times, else the message number. Stamps from a different
/// clock are used only if `trusts_far`. Rules that exclude messages are added to `rules`.
TimeChoice ChooseTime(const TopicTimes& times, bool trusts_far, RuleGuesses* rules);

/// Numbers in the messages of a topic.
class TopicLook {
 public:
  /// `paths` as in TopicTable. `stamp` is the path of the stamp, or empty.
  TopicLook(const std::filesystem::path& bag, const BagTopic& topic, const std::string& stamp,
            const std::vector<std::string>& paths, UnpackedFiles* unpacked);

  std::size_t rows() const { return table_.row_count(); }
  const TopicTimes& times() const { return times_; }
  /// Number of the path with this index; nullopt if the message has none.
  std::optional<double> At(std::size_t row, std::size_t path) const {
    return table_.NumberIfAny(row, path);
  }
  NumbersOfColumn Numbers(std::size_t path) const;
  std::int64_t Count(std::size_t path) const;
  /// Adds rules that exclude messages without a number at one of the paths.
  void AddPresenceRules(const std::vector<std::string>& paths, RuleGuesses* rules) const;

 private:
  LeftOutRows left_out_;
  TopicTable table_;
  TopicTimes times_;
};

}  // namespace tera
