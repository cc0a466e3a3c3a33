#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "campaign/plan/plan.h"
#include "campaign/work/index.h"
#include "campaign/work/worker.h"

namespace tera {

/// Shell text that makes the episodes "$@", one after the other.
///
/// Model   an episode that crashes leaves a failure, as in the pool; one that was killed leaves
///         none. The status is 1 if an episode neither came out nor failed, unless another worker
///         makes it.
std::string WorkerScript(const Plan& plan, const WorkerCommand& worker);

struct SshOptions {
  WorkerCommand worker;
  std::filesystem::path hosts;   ///< sshloginfile of GNU parallel
  std::optional<int> processes;  ///< at once on each host; none: one for each core
};

/// Makes all missing episodes on hosts that see the folder, by GNU parallel over ssh.
///
/// Model   an episode whose host is lost, or that met an obstacle there, is tried three times.
/// Throws  InputError where parallel is not installed or episodes met obstacles to the last.
CampaignState RunOverSsh(const Plan& plan, const SshOptions& options);

struct KubernetesOptions {
  WorkerCommand worker;
  std::string image;                 ///< of a container with `tera`
  std::string claim;                 ///< PersistentVolumeClaim that all computers share
  std::filesystem::path mounted_at;  ///< the same path as where the campaign was planned
  int parallel = 1, memory_mb = 0;   ///< pods at once; memory of each, 0: the cluster's default
};

/// An indexed Job (YAML) whose pod N makes episode N.
///
/// Throws  InputError if the campaign's folders are not on the volume.
std::string KubernetesJob(const Plan& plan, const KubernetesOptions& options);

}  // namespace tera
