#include "sim/events/spill_events.h"

#include <algorithm>

namespace tera {
namespace {

constexpr double kEmptyShare = 0.1, kFillShare = 0.1, kDumpedShare = 0.5;
constexpr double kClear_m = 0.1;
constexpr double kPlaceInWidths = 2;
constexpr double kLeastSpill_kg = 1;
constexpr TimeNs kSpillPause_ns = 500'000'000;
/// Losses within this time are kept as one.
constexpr TimeNs kLossTogether_ns = 100'000'000;

bool IsClear(const Shovel& shovel, const Pose& X_WB, const TerrainSurface& ground) {
  for (const Vec2& point_m : shovel.profile_B_m) {
    for (const double side : {-0.5, 0.5}) {
      const Vec3 p_W_m = X_WB * Vec3(point_m.x(), side * shovel.width_m, point_m.y());
      if (p_W_m.z() < ground.HeightAt(p_W_m.x(), p_W_m.y()) + kClear_m) return false;
    }
  }
  return true;
}

}  // namespace

SpillEvents::SpillEvents(const Scenario& scenario) : scenario_(scenario) {
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) {
    const std::vector<Shovel>& shovels = scenario.machines[m].placement.model.ground_tools.shovels;
    for (std::size_t s = 0; s < shovels.size(); ++s) {
      if (shovels[s].capacity_m3 > 0) carries_.push_back({.machine = m, .shovel = s, .losses = {}});
    }
  }
}

const Shovel& SpillEvents::ShovelOf(const Carry& carry) const {
  return scenario_.machines[carry.machine].placement.model.ground_tools.shovels[carry.shovel];
}

Vec2 SpillEvents::PlaceOfLoad_m(const Carry& carry, const MachineState& machine) const {
  const auto link = static_cast<std::size_t>(ShovelOf(carry).link);
  return (machine.links[link].X_WB * machine.shovel_load[carry.shovel].com_B_m).head<2>();
}

void SpillEvents::Observe(const Instant& before, const Instant& after,
                          const TerrainSurface& ground) {
  for (Carry& carry : carries_) {
    const auto load_kg = [&](const Instant& now) {
      return now.machines[carry.machine].shovel_load[carry.shovel].mass_kg;
    };
    const double was_kg = load_kg(before), is_kg = load_kg(after);
    carry.lowest_kg = is_kg > carry.peak_kg ? is_kg : std::min(carry.lowest_kg, is_kg);
    carry.peak_kg = std::max(carry.peak_kg, is_kg);
    if (is_kg < was_kg) Lose(before, after, was_kg - is_kg, ground, &carry);
    if (is_kg > 0) carry.place_m = PlaceOfLoad_m(carry, after.machines[carry.machine]);
    const bool is_empty = is_kg < kEmptyShare * carry.peak_kg && !carry.losses.empty();
    const bool is_filled =
        carry.HasDumped() && is_kg > carry.lowest_kg + kFillShare * carry.peak_kg;
    if (is_empty || is_filled) {
      Judge(carry, &spills_);
      carry.losses.clear();
      carry.peak_kg = carry.lowest_kg = is_kg;
    }
  }
}

void SpillEvents::Lose(const Instant& before, const Instant& after, double kg,
                       const TerrainSurface& ground, Carry* carry) const {
  const Shovel& shovel = ShovelOf(*carry);
  const MachineState& machine = before.machines[carry->machine];
  const bool is_clear =
      IsClear(shovel, machine.links[static_cast<std::size_t>(shovel.link)].X_WB, ground);
  if (carry->losses.empty() || carry->losses.back().is_clear != is_clear ||
      after.t_ns - carry->losses.back().begin_ns > kLossTogether_ns) {
    carry->losses.push_back({.begin_ns = before.t_ns, .end_ns = after.t_ns, .is_clear = is_clear});
  }
  Loss& loss = carry->losses.back();
  loss.end_ns = after.t_ns;
  loss.kg += kg;
  loss.moment_kgm += kg * PlaceOfLoad_m(*carry, machine);
}

bool SpillEvents::Carry::HasDumped() const { return lowest_kg < kDumpedShare * peak_kg; }

Vec2 SpillEvents::DumpPlace_m(const Carry& carry) {
  if (!carry.HasDumped()) return carry.place_m;
  double all_kg = 0, kg = 0;
  for (const Loss& loss : carry.losses) all_kg += loss.kg;
  Vec2 moment_kgm = Vec2::Zero();
  for (auto loss = carry.losses.rbegin(); loss != carry.losses.rend() && kg < 0.5 * all_kg;
       ++loss) {
    kg += loss->kg;
    moment_kgm += loss->moment_kgm;
  }
  return moment_kgm / kg;
}

void SpillEvents::Judge(const Carry& carry, std::vector<RecordedEvent>* spills) const {
  if (carry.losses.empty()) return;
  const Vec2 dump_m = DumpPlace_m(carry);
  const Shovel& shovel = ShovelOf(carry);
  RecordedEvent spill{.kind = EventKind::kSpill,
                      .machine = scenario_.machines[carry.machine].placement.name,
                      .part = shovel.name,
                      .other = {}};
  const auto end = [&] {
    if (spill.value >= kLeastSpill_kg) spills->push_back(spill);
    spill.value = 0;
  };
  for (const Loss& loss : carry.losses) {
    if (!loss.is_clear || (loss.Place_m() - dump_m).norm() <= kPlaceInWidths * shovel.width_m) {
      continue;
    }
    if (loss.begin_ns - spill.end_ns > kSpillPause_ns) end();
    if (spill.value == 0) spill.begin_ns = loss.begin_ns;
    spill.end_ns = loss.end_ns;
    spill.value += loss.kg;
  }
  end();
}

std::vector<RecordedEvent> SpillEvents::All() const {
  std::vector<RecordedEvent> all = spills_;
  for (const Carry& carry : carries_) Judge(carry, &all);
  return all;
}

}  // namespace tera
