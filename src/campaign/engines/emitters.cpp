#include "campaign/engines/emitters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <csignal>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/child_process.h"
#include "dataset/files/folder_lock.h"
#include "dataset/format/dataset_description.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr int kTriesOverSsh = 3;

bool IsBelow(const fs::path& folder, const fs::path& above) {
  const fs::path relative = folder.lexically_relative(above);
  return !relative.empty() && *relative.begin() != "..";
}

/// A name for the Kubernetes job that is unique to the campaign. It is a DNS label (RFC 1123).
std::string JobName(const Plan& plan) {
  constexpr std::size_t kMostOfName = 40, kOfFingerprint = 8;
  std::string name = "tera-" + plan.campaign.name.substr(0, kMostOfName);
  std::ranges::transform(name, name.begin(), [](unsigned char c) {
    return c == '_' ? '-' : static_cast<char>(std::tolower(c));
  });
  return name + "-" + plan.fingerprint.substr(0, kOfFingerprint);
}

std::string Indented(const std::string& text, const std::string& indent) {
  std::string lines = indent;
  for (std::size_t k = 0; k < text.size(); ++k) {
    lines += text[k];
    if (text[k] == '\n' && k + 1 < text.size()) lines += indent;
  }
  return lines;
}

}  // namespace

std::string WorkerScript(const Plan& plan, const WorkerCommand& worker) {
  std::string arguments;
  for (const std::string& word : worker.arguments) arguments += " " + ShellWord(word);
  std::string crashes;  // shell exit statuses after these signals
  for (const int signal : kCrashSignals) {
    crashes += fmt::format("{}{}", crashes.empty() ? "" : "|", 128 + signal);
  }
  return fmt::format(R"(status=0
for number; do
  {} campaign run {} --index "$number"{}; ended=$?
  failure={}/$(printf %06d "$number").yaml
  case $ended in {})
    printf 'reason: bug\nmessage: "crashed by signal %d"\n' $((ended - 128)) > "$failure.part"
    mv "$failure.part" "$failure"
  esac
  [ $ended -eq 0 ] || [ -e "$failure" ] || status=1
done
exit $status
)",
                     ShellWord(worker.program), ShellWord(plan.folder), arguments,
                     ShellWord(plan.folder / "failed"), crashes);
}

CampaignState RunOverSsh(const Plan& plan, const SshOptions& options) {
  const FolderLock lock(plan.folder);
  const CampaignState before = RefreshIndex(plan);
  if (before.missing.empty()) return before;
  const fs::path script = plan.folder / "worker.sh";
  WriteWholeFile(script, "#!/bin/sh\n" + WorkerScript(plan, options.worker));
  std::string arguments = fmt::format("--will-cite --sshloginfile {} --retries {} --joblog {}",
                                      ShellWord(fs::absolute(options.hosts)), kTriesOverSsh,
                                      ShellWord(plan.folder / "logs/parallel.tsv"));
  if (options.processes) arguments += fmt::format(" --jobs {}", *options.processes);
  std::signal(SIGCHLD, SIG_DFL);  // if the parent ignored SIGCHLD, the child's status would be lost
  // parallel joins its arguments to one line, which a shell parses again, so the script is quoted
  // twice.
  ChildProcess parallel("parallel", arguments + " sh " + ShellWord(ShellWord(script)),
                        "install the package parallel; logs/parallel.tsv in the campaign's folder "
                        "has the status of each episode and host");
  parallel.Write(fmt::format("{}\n", fmt::join(before.missing, "\n")));
  parallel.Close();
  return RefreshIndex(plan);
}

std::string KubernetesJob(const Plan& plan, const KubernetesOptions& options) {
  for (const fs::path& folder : {plan.folder, plan.campaign.folder}) {
    if (IsBelow(folder, options.mounted_at)) continue;
    throw InputError("--volume", {FaultKind::kInconsistent,
                                  fmt::format("{} is not below {}, so no pod sees it; plan the "
                                              "campaign on the volume, mounted there",
                                              folder.string(), options.mounted_at.string())});
  }
  const int episodes = plan.campaign.episodes;
  const std::string memory =
      options.memory_mb > 0
          ? fmt::format(
                "          resources: {{requests: {{memory: {0}M}}, limits: {{memory: "
                "{0}M}}}}\n",
                options.memory_mb)
          : "";
  return fmt::format(
      R"(apiVersion: batch/v1
kind: Job
metadata:
  name: {}
spec:
  completionMode: Indexed
  completions: {}
  parallelism: {}
  backoffLimit: {}
  template:
    spec:
      restartPolicy: Never
      containers:
        - name: worker
          image: {}
          command: [/bin/sh, -c]
          args:
            - |
              set -- "$JOB_COMPLETION_INDEX"
{}{}          volumeMounts:
            - {{name: shared, mountPath: {}}}
      volumes:
        - name: shared
          persistentVolumeClaim: {{claimName: {}}}
)",
      JobName(plan), episodes, std::min(options.parallel, episodes), episodes,
      YamlQuoted(options.image), Indented(WorkerScript(plan, options.worker), std::string(14, ' ')),
      memory, YamlQuoted(options.mounted_at.string()), YamlQuoted(options.claim));
}

}  // namespace tera
