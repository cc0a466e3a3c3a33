#include "app/progress/diagnose_progress.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdio>
#include <vector>

namespace tera {
namespace {

constexpr const char* kToEndOfLine = "\x1b[K";  ///< clears the rest of the line

/// Text such as "dead_band, 1 unexplained".
std::string Outcome(const BlockDiagnosis& diagnosis) {
  if (diagnosis.out_of_time) return "out of time";
  if (!diagnosis.is_testable) return "too few manoeuvres";
  std::vector<std::string> parts;
  for (const Finding& finding : diagnosis.findings) {
    parts.emplace_back(finding.term.candidate->mechanism->id);
  }
  if (!diagnosis.unexplained.empty()) {
    parts.push_back(fmt::format("{} unexplained", diagnosis.unexplained.size()));
  }
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

DiagnoseProgress::DiagnoseProgress(StageClock* clock)
    : terminal_(isatty(STDERR_FILENO) == 1),
      clock_(clock),
      start_(Clock::now()),
      search_start_(start_) {}

void DiagnoseProgress::Show(const BlockProgress& progress) {
  const Clock::time_point now = Clock::now();
  const auto since_s = [&](Clock::time_point then) {
    return std::chrono::duration<double>(now - then).count();
  };
  if (progress.done == nullptr) {
    if (block_starts_.empty()) search_start_ = now;
    block_starts_[progress.block] = now;
  } else {
    clock_->AddPart(progress.block, since_s(block_starts_.at(progress.block)));
    block_starts_.erase(progress.block);
    if (block_starts_.empty())
      clock_->Add("search, several blocks at once", since_s(search_start_));
  }
  if (progress.done != nullptr) {
    fmt::print(stderr, "{}{}: {} ({} of {}): {}, {:.0f} s so far{}\n", terminal_ ? "\r" : "",
               progress.machine, progress.block, progress.number, progress.count,
               Outcome(*progress.done), since_s(start_), terminal_ ? kToEndOfLine : "");
  }
  if (!terminal_) return;
  std::vector<std::string> under_way;
  for (const auto& [block, start] : block_starts_) under_way.push_back(block);
  if (!under_way.empty()) {
    fmt::print(stderr, "\r{}: {} ..{}", progress.machine, fmt::join(under_way, " and "),
               kToEndOfLine);
  }
  std::fflush(stderr);
}

}  // namespace tera
