// Rate of false alarms of `tera diagnose` in recordings without any error.
//
//   false_alarms [RECORDINGS [SECONDS [FIRST_SEED]]]
//
// prints each alarm, and the share of recordings with alarms, with Wilson's interval.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "diagnose/null/null_recording.h"

namespace {

struct Interval {
  double low = 0, high = 0;
};

/// Wilson's 95 % interval of a proportion.
/// Source  Wilson 1927, "Probable inference, the law of succession, and statistical inference".
Interval WilsonInterval(std::size_t successes, std::size_t trials) {
  constexpr double kZ = 1.959964;
  const auto n = static_cast<double>(trials);
  const double share = static_cast<double>(successes) / n;
  const double centre = share + kZ * kZ / (2 * n);
  const double half = kZ * std::sqrt(share * (1 - share) / n + kZ * kZ / (4 * n * n));
  return {(centre - half) / (1 + kZ * kZ / n), (centre + half) / (1 + kZ * kZ / n)};
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int k, double otherwise) {
    return argc > k ? std::atof(argv[k]) : otherwise;
  };
  const auto recordings = static_cast<std::size_t>(number(1, 200));
  const double duration_s = number(2, 90);
  const auto first = static_cast<std::uint64_t>(number(3, 1));
  const tera::MachineModel model = tera::RaisedTb235();
  std::size_t alarms = 0, unconfirmed = 0, judged = 0, blocks = 0;
  for (std::size_t k = 0; k < recordings; ++k) {
    const tera::NullOutcome outcome = tera::DiagnoseNull(model, duration_s, first + k);
    alarms += outcome.alarms.empty() ? 0 : 1;
    unconfirmed += outcome.unconfirmed.empty() ? 0 : 1;
    judged += outcome.judged;
    blocks += outcome.blocks;
    for (const std::string& alarm : outcome.alarms) {
      fmt::print("seed {}: {}\n", first + k, alarm);
    }
    for (const std::string& chosen : outcome.unconfirmed) {
      fmt::print("seed {}: not confirmed: {}\n", first + k, chosen);
    }
    std::fflush(stdout);
  }
  const Interval share = WilsonInterval(alarms, recordings);
  fmt::print(
      "{} recordings of {} s, {} of {} blocks judged\nfalse alarms: {} = {:.1f} % (95 %: {:.1f} to "
      "{:.1f} %); chosen and not confirmed in {}\n",
      recordings, duration_s, judged, blocks, alarms, 100.0 * alarms / recordings, 100 * share.low,
      100 * share.high, unconfirmed);
}
