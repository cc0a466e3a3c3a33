#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/import/bag/topic_table.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// The times of a topic's messages, and their continuity.
struct TopicTimes {
  std::string stamp;  ///< path of their own stamp; empty: none
  TimeSteps own_steps, log_steps;
  std::int64_t unfilled = 0;  ///< own times of 0
  TimeNs first_own_ns = 0, first_log_ns = 0, last_log_ns = 0;
  std::vector<TimeNs> t_ns;  ///< times of all messages: their own if usable, else the recorder's
  TimeNs ahead_ns = 0;       ///< recording time minus own time of the first message

  /// Whether their own times are usable.
  bool HasStamps() const;
  /// Whether these are of another clock than the recorder's.
  bool IsFar() const;
};

/// A mapping's text on the time of a channel, and on rows left out for it.
struct TimeChoice {
  std::string yaml;  ///< an unindented line "time: {...}   # guessed: ...", or nothing
  TimeNs first_ns = 0;
};
/// Their own times if usable, else the recording times, else the message number. Times of another
/// clock are used only if `trusts_far`.
TimeChoice ChooseTime(const TopicTimes& times, bool trusts_far, RuleGuesses* rules);

/// Numbers of a topic's messages.
class TopicLook {
 public:
  /// `paths` as in TopicTable; `stamp` is the path of their own times, or empty.
  TopicLook(const std::filesystem::path& bag, const BagTopic& topic, const std::string& stamp,
            const std::vector<std::string>& paths, UnpackedFiles* unpacked);

  std::size_t rows() const { return table_.row_count(); }
  const TopicTimes& times() const { return times_; }
  /// By the index of its path; nothing if the message has no number there.
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
