#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "campaign/plan/plan.h"
#include "campaign/work/index.h"
#include "campaign/work/worker.h"

namespace tera {

/// Shell script that runs the episodes "$@" one after another.
///
/// Model   An episode that crashes leaves a failure file, as in the pool. An episode that is killed
///         leaves none. The exit status is 1 if any episode neither succeeded nor failed, unless
///         another worker runs that episode.
std::string WorkerScript(const Plan& plan, const WorkerCommand& worker);

struct SshOptions {
  WorkerCommand worker;
  std::filesystem::path hosts;   ///< file with the hosts: --sshloginfile of GNU parallel
  std::optional<int> processes;  ///< episodes at a time per host; absent: one per core
};

/// Runs all missing episodes by GNU parallel over ssh. All hosts must share the campaign's folder.
///
/// Model   An episode is tried three times if its host is lost or has an obstacle, such as a full
///         disk.
/// Throws  InputError if parallel is not installed, or if episodes still met obstacles in their
///         last try.
CampaignState RunOverSsh(const Plan& plan, const SshOptions& options);

struct KubernetesOptions {
  WorkerCommand worker;
  std::string image;                 ///< container image with `tera`
  std::string claim;                 ///< PersistentVolumeClaim that all nodes share
  std::filesystem::path mounted_at;  ///< mount point of the volume; the path at which the campaign
                                     ///< was planned
  int parallel = 1, memory_mb = 0;   ///< pods at a time; memory per pod, 0: default of the cluster
};

/// YAML of an indexed Job in which pod N runs episode N.
///
/// Throws  InputError if the folders of the campaign are not on the volume.
std::string KubernetesJob(const Plan& plan, const KubernetesOptions& options);

}  // namespace tera
