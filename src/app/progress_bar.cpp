#include "app/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace tera {
namespace {

constexpr int kBarWidth = 24;

}  // namespace

ProgressBar::ProgressBar()
    : terminal_(isatty(STDERR_FILENO) == 1), start_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() {
  if (shown_) fmt::print(stderr, "\n");
}

void ProgressBar::Show(const GenerateProgress& progress) {
  if (!terminal_) return;
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double done = std::clamp(progress.simulated_s / progress.duration_s, 0.0, 1.0);
  const double factor = wall_s > 0 ? progress.simulated_s / wall_s : 0.0;
  const double left_s = done > 0 ? wall_s * (1 - done) / done : 0.0;
  const int filled = static_cast<int>(done * kBarWidth);
  fmt::print(stderr, "\r[{}{}] {:7.2f} / {:.1f} s  {:6.2f} x real time  {} frames  {:.0f} s left  ",
             std::string(filled, '#'), std::string(kBarWidth - filled, '.'), progress.simulated_s,
             progress.duration_s, factor, progress.frames, left_s);
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace tera
