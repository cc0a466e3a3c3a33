#include "sim/operators/random_levers.h"

#include <fmt/format.h>

namespace tera {
namespace {

constexpr double kNeutralShare = 0.25;
enum Which : std::uint32_t { kDuration, kChoice, kPosition, kWhichCount };

}  // namespace

RandomLevers::RandomLevers(const RandomLeversPlan& plan, const MachineModel& model,
                           const OperatorStream& stream)
    : plan_(plan),
      stream_(stream.seed, stream.machine + "/operator/random_levers"),
      pieces_(model.levers.size()),
      levers_(model.levers.size(), 0.0) {}

double RandomLevers::Draw(std::int64_t piece, std::size_t lever, std::uint32_t which) const {
  return stream_.Uniform(static_cast<std::uint64_t>(piece),
                         static_cast<std::uint32_t>(lever) * kWhichCount + which);
}

double RandomLevers::Position(std::int64_t piece, std::size_t lever) const {
  if (Draw(piece, lever, kChoice) < kNeutralShare) return 0;
  return plan_.amplitude * (2 * Draw(piece, lever, kPosition) - 1);
}

bool RandomLevers::Advance(TimeNs t_ns, std::size_t lever, bool and_back, Piece* piece) const {
  if (t_ns < piece->until_ns) return false;
  ++piece->index;
  const std::int64_t drawn = and_back ? piece->index / 2 : piece->index;
  piece->until_ns += FromSeconds(plan_.shortest_s + (plan_.longest_s - plan_.shortest_s) *
                                                        Draw(drawn, lever, kDuration));
  return true;
}

std::vector<double> RandomLevers::Levers(const OperatorView& view) {
  const bool gears_change = Advance(view.t_ns, levers_.size(), true, &gears_);
  const double direction = gears_.index % 2 == 0 ? 1 : -1;
  for (std::size_t i = 0; i < levers_.size(); ++i) {
    if (view.model.levers[i].gear >= 0) {
      if (gears_change) levers_[i] = direction * Position(gears_.index / 2, i);
    } else if (Advance(view.t_ns, i, false, &pieces_[i])) {
      levers_[i] = Position(pieces_[i].index, i);
    }
  }
  return levers_;
}

RandomLeversPlan ReadRandomLevers(const ConfigMap& config) {
  constexpr double kShortest_s = 0.01, kLongest_s = 3600;
  RandomLeversPlan plan;
  plan.shortest_s =
      config.Number("shortest_s", Between(kShortest_s, kLongest_s, "s"), plan.shortest_s);
  plan.longest_s =
      config.Number("longest_s", Between(kShortest_s, kLongest_s, "s"), plan.longest_s);
  plan.amplitude = config.Number("amplitude", Between(0, 1, "1"), plan.amplitude);
  if (plan.longest_s < plan.shortest_s) {
    config.Fault("longest_s", fmt::format("{} s is shorter than shortest_s, {} s", plan.longest_s,
                                          plan.shortest_s));
  }
  return plan;
}

}  // namespace tera
