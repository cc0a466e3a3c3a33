#include "dataset/import/suggest/topic_look.h"

#include <fmt/format.h>

#include <cstdlib>

namespace tera {
namespace {

/// `paths`, followed by the columns of times.
std::vector<std::string> WithTimes(std::vector<std::string> paths, const std::string& stamp) {
  paths.push_back(kLogTime);
  if (!stamp.empty()) paths.push_back(stamp);
  return paths;
}

std::string TimeYaml(const std::string& value, const std::string& reason) {
  return fmt::format("time: {{{}}}   # guessed: {}\n", value, reason);
}

/// Reason for not using the stamps; empty if they are usable.
std::string WhyNotOwn(const TopicTimes& times, bool trusts_far) {
  if (times.own_steps.rows == 0) return "their own is always 0";
  if (times.own_steps.IsStuck()) {
    return fmt::format("{} of {} of their own repeat the one before", times.own_steps.repeated,
                       times.own_steps.rows);
  }
  if (times.own_steps.back > 0) {
    return fmt::format("{} of {} of their own go back", times.own_steps.back, times.own_steps.rows);
  }
  if (times.IsFar() && !trusts_far) {
    return fmt::format(
        "their own is {:.0f} s from the time of recording and comes from another clock",
        ToSeconds(times.ahead_ns));
  }
  return "";
}

}  // namespace

bool TopicTimes::HasStamps() const {
  return own_steps.rows > 0 && !own_steps.IsStuck() && own_steps.back == 0;
}

bool TopicTimes::IsFar() const {
  constexpr TimeNs kFar_ns = 3600 * kNsPerSecond;
  return std::abs(ahead_ns) > kFar_ns;
}

TimeChoice ChooseTime(const TopicTimes& times, bool trusts_far, RuleGuesses* rules) {
  std::string reason;
  if (!times.stamp.empty()) {
    reason = WhyNotOwn(times, trusts_far);
    if (reason.empty()) {
      if (times.unfilled > 0) {
        rules->Add(fmt::format("{{column: {}, above: 0}}", YamlWord(times.stamp)),
                   fmt::format("{} times are 0", times.unfilled));
      }
      AddStepRule(times.own_steps, YamlWord(times.stamp), rules);
      return {"", times.first_own_ns};
    }
  }
  const TimeSteps& log = times.log_steps;
  if (!log.IsStuck() && log.back == 0) {
    AddStepRule(log, kLogTime, rules);
    if (reason.empty()) return {"", times.first_log_ns};
    return {TimeYaml(fmt::format("column: {}", kLogTime), reason), times.first_log_ns};
  }
  const double span_s = ToSeconds(times.last_log_ns - times.first_log_ns);
  const double interval_s =
      log.rows > 1 && span_s > 0 ? span_s / static_cast<double>(log.rows - 1) : 0.01;
  return {TimeYaml(fmt::format("interval: {:.9g}, unit: s, offset: {:.9f}", interval_s,
                               ToSeconds(times.first_log_ns)),
                   (reason.empty() ? "" : reason + "; ") + "those of the recorder do not increase"),
          times.first_log_ns};
}

TopicLook::TopicLook(const std::filesystem::path& bag, const BagTopic& topic,
                     const std::string& stamp, const std::vector<std::string>& paths,
                     UnpackedFiles* unpacked)
    : table_(bag, topic, WithTimes(paths, stamp), unpacked, &left_out_) {
  times_.stamp = stamp;
  const std::size_t log = paths.size(), own = paths.size() + 1;
  std::vector<TimeNs> log_times;
  for (std::size_t row = 0; row < table_.row_count(); ++row) {
    const TimeNs log_ns = table_.Stamp(row, log).value_or(0);
    if (row == 0) times_.first_log_ns = log_ns;
    times_.last_log_ns = log_ns;
    times_.log_steps.Add(log_ns);
    const auto own_ns = stamp.empty() ? std::nullopt : table_.Stamp(row, own);
    log_times.push_back(log_ns);
    times_.t_ns.push_back(own_ns ? *own_ns : 0);
    if (!own_ns) continue;
    if (*own_ns == 0) {
      ++times_.unfilled;
      continue;
    }
    if (times_.own_steps.rows == 0) {
      times_.first_own_ns = *own_ns;
      times_.ahead_ns = log_ns - *own_ns;
    }
    times_.own_steps.Add(*own_ns);
  }
  // A clock that starts at 0, such as a simulation clock, has a single stamp of 0, the first.
  const bool begins_at_zero = times_.unfilled == 1 && times_.own_steps.rows > 0 &&
                              table_.Stamp(0, own) == TimeNs{0} &&
                              times_.first_own_ns < FromSeconds(kLeastEpoch_s);
  if (begins_at_zero) times_.unfilled = times_.first_own_ns = 0;
  if (!times_.HasStamps() || times_.unfilled > 0) times_.t_ns = std::move(log_times);
}

NumbersOfColumn TopicLook::Numbers(std::size_t path) const {
  NumbersOfColumn numbers;
  for (std::size_t row = 0; row < rows(); ++row) {
    if (const auto value = At(row, path)) numbers.values.push_back(*value);
  }
  return numbers;
}

std::int64_t TopicLook::Count(std::size_t path) const {
  return static_cast<std::int64_t>(Numbers(path).values.size());
}

void TopicLook::AddPresenceRules(const std::vector<std::string>& paths, RuleGuesses* rules) const {
  for (std::size_t p = 0; p < paths.size(); ++p) {
    const std::int64_t lacking = static_cast<std::int64_t>(rows()) - Count(p);
    if (lacking == 0) continue;
    rules->Add(fmt::format("{{column: {}, present: true}}", YamlWord(paths[p])),
               fmt::format("{} messages have no number there", lacking));
  }
}

}  // namespace tera
