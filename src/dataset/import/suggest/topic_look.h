#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/import/bag/topic_table.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Where the messages of a topic have their times, and how these go on.
struct TopicTimes {
  std::string stamp;  ///< the path of their own; empty: they have none
  TimeSteps own_steps, log_steps;
  std::int64_t unfilled = 0;  ///< own times of 0
  TimeNs first_own_ns = 0, first_log_ns = 0, last_log_ns = 0;
  std::vector<TimeNs> t_ns;  ///< of all messages, their own where they go on, else the recorder's
  TimeNs ahead_ns = 0;       ///< the first message's time of recording less its own

  /// Whether their own times go on.
  bool HasStamps() const;
  /// Whether these are of another clock than the recorder's.
  bool IsFar() const;
};

/// The text of a mapping on the time of a channel, and on the rows that it leaves out for it.
struct TimeChoice {
  std::string yaml;  ///< a line without indent, "time: {...}   # guessed: ...", or nothing
  TimeNs first_ns = 0;
};
/// Their own times where these go on, else when they were recorded, else by their number; far ones
/// only where `trusts_far`.
TimeChoice ChooseTime(const TopicTimes& times, bool trusts_far, RuleGuesses* rules);

/// Numbers of a topic's messages.
class TopicLook {
 public:
  /// `paths` as of TopicTable; `stamp` the path of their own times, or nothing.
  TopicLook(const std::filesystem::path& bag, const BagTopic& topic, const std::string& stamp,
            const std::vector<std::string>& paths, UnpackedFiles* unpacked);

  std::size_t rows() const { return table_.row_count(); }
  const TopicTimes& times() const { return times_; }
  /// By the place of its path; nothing where the message has no number there.
  std::optional<double> At(std::size_t row, std::size_t path) const {
    return table_.NumberIfAny(row, path);
  }
  NumbersOfColumn Numbers(std::size_t path) const;
  std::int64_t Count(std::size_t path) const;
  /// Leaves out rows without a number at one of the paths.
  void AddPresenceRules(const std::vector<std::string>& paths, RuleGuesses* rules) const;

 private:
  LeftOutRows left_out_;
  TopicTable table_;
  TopicTimes times_;
};

}  // namespace tera
