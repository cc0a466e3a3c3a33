#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.h"
#include "dataset/format/events_table.h"
#include "dataset/lint/lint_job.h"

namespace tera {
namespace {

/// Longest physics step: a run ends with the step that reaches its duration.
constexpr TimeNs kLongestStep_ns = 10'000'000;

void CheckEvent(LintJob* job, const std::string& channel, int line, const RecordedEvent& event) {
  const auto find = [&](const std::string& what) {
    job->Find("events.rows", channel, {channel, line, what});
  };
  if (event.begin_ns < 0) {
    find(fmt::format(
        "begins at {:.12g} s; need 0 or later: count time from the start of the recording",
        ToSeconds(event.begin_ns)));
  }
  const double duration_s = job->recording().info().duration_s;
  if (event.end_ns > FromSeconds(duration_s) + kLongestStep_ns) {
    find(fmt::format(
        "ends at {:.12g} s, after the recording; need at most {} s: end the event there, "
        "or correct duration_s of dataset.yaml",
        ToSeconds(event.end_ns), duration_s));
  }
  const std::vector<std::string> machines = job->recording().Machines();
  if (!event.machine.empty() && std::ranges::count(machines, event.machine) == 0) {
    find(fmt::format("is of machine '{}', which has no channels; need a machine of the recording",
                     event.machine));
  }
}

}  // namespace

void CheckEvents(LintJob* job) {
  for (const std::string& channel : job->recording().ChannelsOf(kEventsChannel)) {
    job->Try(channel, [&] {
      job->Applies("events.rows");
      std::set<int> faulty;
      const auto find = [&](int line, const std::string& what) {
        faulty.insert(line);
        job->Find("events.rows", channel, {channel, line, what});
      };
      try {
        int line = 1;  // the header
        for (const RecordedEvent& event : ReadEvents(job->Path(channel), find)) {
          do ++line;
          while (faulty.contains(line));
          CheckEvent(job, channel, line, event);
        }
      } catch (const InputError& error) {
        find(1, error.what());
      }
    });
  }
}

}  // namespace tera
