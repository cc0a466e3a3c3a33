#include "app/diagnose_progress.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdio>
#include <utility>
#include <vector>

namespace tera {
namespace {

/// "dead_band, 1 unexplained".
std::string Outcome(const BlockDiagnosis& diagnosis) {
  if (diagnosis.out_of_time) return "out of time";
  if (!diagnosis.is_testable) return "too few manoeuvres";
  std::vector<std::string> parts;
  for (const Finding& finding : diagnosis.findings) {
    parts.emplace_back(finding.term.suspect->mechanism->id);
  }
  if (!diagnosis.unexplained.empty()) {
    parts.push_back(fmt::format("{} unexplained", diagnosis.unexplained.size()));
  }
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

DiagnoseProgress::DiagnoseProgress(std::string machine, StageClock* clock)
    : machine_(std::move(machine)),
      terminal_(isatty(STDERR_FILENO) == 1),
      clock_(clock),
      start_(Clock::now()),
      block_start_(start_) {}

void DiagnoseProgress::Show(const BlockProgress& progress) {
  const Clock::time_point now = Clock::now();
  const auto since_s = [&](Clock::time_point then) {
    return std::chrono::duration<double>(now - then).count();
  };
  if (progress.done == nullptr) {
    block_start_ = now;
  } else {
    clock_->Add("search: " + progress.block, since_s(block_start_));
  }
  if (!terminal_) return;
  const std::string block =
      fmt::format("{}: {} ({} of {})", machine_, progress.block, progress.number, progress.count);
  if (progress.done == nullptr) {
    fmt::print(stderr, "{} ..", block);
  } else {
    fmt::print(stderr, "\r{}: {}, {:.0f} s so far\x1b[K\n", block, Outcome(*progress.done),
               since_s(start_));
  }
  std::fflush(stderr);
}

}  // namespace tera
