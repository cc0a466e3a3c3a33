#include "blind/plant/messages.h"

#include <algorithm>
#include <cmath>

namespace tera::blind {
namespace {

constexpr double kCentred = 0.01;  ///< of the lever, at which springs have the spool to themselves

}  // namespace

void Messages::Send(double t_s, double lever) {
  // A slow reader sees only what is there when it looks.
  if (form_.hold_s > 0) {
    if (t_s < looked_s_ + form_.hold_s - 1e-9) return;
    looked_s_ = t_s;
  }
  const double late_s =
      form_.queue_s + form_.queue_jitter_s * std::abs(stream_.Gaussian(sent_.size()));
  double comes_s = t_s + late_s;
  if (!sent_.empty()) comes_s = std::max(comes_s, sent_.back().comes_s + 1e-6);
  sent_.push_back({comes_s, lever});
}

double Messages::At(double t_s) {
  while (next_ < sent_.size() && sent_[next_].comes_s <= t_s + 1e-9) {
    const double lever = sent_[next_++].lever, play = form_.spool_play / 2;
    held_ = std::abs(lever) <= kCentred ? 0.0 : std::clamp(held_, lever - play, lever + play);
  }
  return held_;
}

double Messages::Next(double t_s) const {
  for (std::size_t i = next_; i < sent_.size(); ++i) {
    if (sent_[i].comes_s > t_s + 1e-9) return sent_[i].comes_s;
  }
  return 1e9;
}

}  // namespace tera::blind
