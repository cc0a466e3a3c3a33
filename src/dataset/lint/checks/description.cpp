#include <fmt/format.h>

#include <set>

#include "dataset/lint/lint_job.h"

// Checks the content of a readable dataset.yaml.

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr char kDescription[] = "dataset.yaml";

bool IsPlain(const std::string& channel) {
  const fs::path path(channel);
  return !channel.empty() && path.is_relative() && path.lexically_normal() == path &&
         path.has_filename() && *path.begin() != ".." && *path.begin() != ".";
}

void CheckPaths(LintJob* job) {
  job->Applies("dataset.paths");
  std::set<std::string> seen;
  for (const ChannelDescription& channel : job->recording().channels()) {
    if (!IsPlain(channel.path)) {
      job->Find("dataset.paths", channel.path,
                {kDescription, 0, fmt::format("'{}' leads out of the dataset", channel.path)});
      job->LeaveOut(channel.path);
    } else if (!seen.insert(channel.path).second) {
      job->Find("dataset.paths", channel.path,
                {kDescription, 0, fmt::format("'{}' is listed twice", channel.path)});
    }
  }
}

void CheckInstances(LintJob* job) {
  const std::vector<DatasetInfo::Instance>& instances = job->recording().info().instances;
  if (instances.empty()) return;
  job->Applies("dataset.instances");
  std::set<std::string> classes;
  for (int id = 0; id < 256; ++id) classes.insert(job->ClassName(id));
  std::set<std::uint16_t> seen;
  const auto find = [&](const DatasetInfo::Instance& instance, const std::string& what) {
    job->Find(
        "dataset.instances", "",
        {kDescription, 0, fmt::format("instance {} ({}) {}", instance.id, instance.name, what)});
  };
  for (const DatasetInfo::Instance& instance : instances) {
    if (instance.id == 0) find(instance, "has the id 0, which means no instance");
    if (!seen.insert(instance.id).second) find(instance, "has the id of another instance");
    if (!classes.contains(instance.label)) {
      find(instance, fmt::format("has the class '{}', which is not listed", instance.label));
    }
    const bool has_parent = instance.parent == 0 || (instance.parent != instance.id &&
                                                     job->InstanceOf(instance.parent) != nullptr);
    if (!has_parent)
      find(instance,
           fmt::format("has the parent {}, which is not another listed instance", instance.parent));
  }
}

/// Detects an epoch in ms or us instead of ns, which gives a date before 1990.
void CheckEpoch(LintJob* job) {
  constexpr TimeNs kYear1990_ns = 631'152'000 * kNsPerSecond;
  const std::optional<RecordingEpoch>& epoch = job->recording().info().epoch;
  if (!epoch) return;
  job->Applies("dataset.epoch");
  if (epoch->since_1970_ns >= kYear1990_ns) return;
  job->Find(
      "dataset.epoch", "",
      {kDescription, 0,
       fmt::format("the epoch is {:.0f} s after 1970-01-01", ToSeconds(epoch->since_1970_ns))});
}

}  // namespace

void CheckDescription(LintJob* job) {
  CheckPaths(job);
  CheckEpoch(job);
  CheckInstances(job);
}

}  // namespace tera
