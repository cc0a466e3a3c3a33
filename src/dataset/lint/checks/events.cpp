#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "dataset/format/events_table.h"
#include "dataset/lint/lint_job.h"

namespace tera {
namespace {

void CheckEvent(LintJob* job, const std::string& channel, const RecordedEvent& event) {
  const auto find = [&](const std::string& what) {
    job->Find("events.rows", channel,
              {channel, 0, fmt::format("the event of t_ns {} {}", event.begin_ns, what)});
  };
  const double duration_s = job->recording().info().duration_s;
  if (event.begin_ns < 0 || event.end_ns > FromSeconds(duration_s)) {
    find(fmt::format("ends at {} s, need 0 to {} s", ToSeconds(event.end_ns), duration_s));
  }
  const std::vector<std::string> machines = job->recording().Machines();
  if (!event.machine.empty() && std::ranges::count(machines, event.machine) == 0) {
    find(fmt::format("is of machine '{}', which has no channels", event.machine));
  }
}

}  // namespace

void CheckEvents(LintJob* job) {
  for (const std::string& channel : job->recording().ChannelsOf(kEventsChannel)) {
    job->Try(channel, [&] {
      job->Applies("events.rows");
      const auto find = [&](int line, const std::string& what) {
        job->Find("events.rows", channel, {channel, line, what});
      };
      try {
        for (const RecordedEvent& event : ReadEvents(job->Path(channel), find)) {
          CheckEvent(job, channel, event);
        }
      } catch (const InputError& error) {
        find(1, error.what());
      }
    });
  }
}

}  // namespace tera
