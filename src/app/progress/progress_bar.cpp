#include "app/progress/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace tera {
namespace {

constexpr int kWidestBar = 24;
constexpr int kUsualColumns = 80;

/// Usable columns of the terminal. A full line would wrap, and \r would return to the wrong line.
int TerminalColumns() {
  winsize size = {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsualColumns;
}

std::string Clock(double seconds) {
  const auto whole_s = static_cast<std::int64_t>(std::ceil(seconds));
  return fmt::format("{}:{:02}", whole_s / 60, whole_s % 60);
}

/// A bar that fills the free width, followed by `text`. A text that is too long is cut.
std::string Line(double done, const std::string& text, int columns) {
  const int room = std::min(kWidestBar, columns - 4 - static_cast<int>(text.size()));
  if (room < 1) return text.substr(0, static_cast<std::size_t>(columns - 1));
  const int filled = static_cast<int>(done * room);
  return fmt::format("[{}{}] {}", std::string(filled, '#'), std::string(room - filled, '.'), text);
}

}  // namespace

ProgressBar::ProgressBar(double line_s)
    : terminal_(isatty(STDERR_FILENO) == 1),
      line_s_(line_s),
      start_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() {
  if (shown_) fmt::print(stderr, "\n");
}

void ProgressBar::Show(const GenerateProgress& progress, std::string_view counted) {
  if (!terminal_ && line_s_ <= 0) return;
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double done = std::clamp(progress.simulated_s / progress.duration_s, 0.0, 1.0);
  const double factor = wall_s > 0 ? progress.simulated_s / wall_s : 0.0;
  const double left_s = done > 0 ? wall_s * (1 - done) / done : 0.0;
  if (!terminal_) {
    if (wall_s < last_line_s_ + line_s_) return;
    last_line_s_ = wall_s;
    fmt::print(stderr, "{:.1f} of {:.1f} s, about {} left\n", progress.simulated_s,
               progress.duration_s, Clock(left_s));
    return;
  }
  const std::string text =
      fmt::format("{:.1f} / {:.1f} s  {:.2f} x real time  {} {}  {} left", progress.simulated_s,
                  progress.duration_s, factor, progress.frames, counted, Clock(left_s));
  // ESC [ K clears the rest of the previous line.
  fmt::print(stderr, "\r{}\x1b[K", Line(done, text, TerminalColumns()));
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace tera
