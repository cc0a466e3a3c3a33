#include <algorithm>

#include "dataset/format/recording.h"
#include "dataset/lint/lint.h"
#include "dataset/lint/lint_job.h"

// Runs all checks.

namespace tera {
namespace {

/// Order matters: early checks exclude unreadable channels from later checks.
constexpr std::array kChecks = {
    CheckDescription, CheckFiles,         CheckRows,        CheckPoses,  CheckCommands,
    CheckEncoders,    CheckInertialUnits, CheckReceivers,   CheckEvents, CheckCameras,
    CheckLidars,      CheckScansByDepth,  CheckFlowByPoses, CheckHashes};

}  // namespace

std::int64_t LintReport::CountOf(Severity severity) const {
  return std::count_if(findings.begin(), findings.end(), [&](const LintFinding& finding) {
    return finding.rule->severity == severity;
  });
}

LintReport Lint(const std::filesystem::path& dataset, const LintOptions& options) {
  const Recording recording(dataset);
  LintJob job(recording, options);
  job.Applies("dataset.unchecked");
  for (const auto& check : kChecks) {
    job.Try("", [&] { check(&job); });
  }
  return std::move(job).Report();
}

}  // namespace tera
