#pragma once

#include <vector>

#include "core/types/terrain_surface.h"
#include "sim/events/held_events.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Soil that falls out of shovels on the way.
///
/// Model   A shovel carries from when soil enters it until less than a tenth of its largest load is
///         left, or until soil enters again after it has dumped: after less than half was left
///         (soil that sticks stays). It dumps where the last half of what leaves it falls: mean
///         place of the load's centre of mass, by mass. spill: soil that leaves it while it is
///         clear of the ground by 0.1 m, farther away than twice its width from there; losses with
///         pauses up to 0.5 s are one. The value is the mass, from 1 kg. A load that is not dumped
///         at the end of the recording counts as dumped where it is.
/// Omits   soil that slides off in the ground; blades, which carry nothing.
class SpillEvents {
 public:
  /// Keeps a reference.
  explicit SpillEvents(const Scenario& scenario);

  void Observe(const Instant& before, const Instant& after, const TerrainSurface& ground);
  /// With the spills of loads that are still carried.
  std::vector<RecordedEvent> All() const;

 private:
  struct Loss {
    TimeNs begin_ns, end_ns;
    bool is_clear;  ///< of the ground
    double kg = 0;
    Vec2 moment_kgm = Vec2::Zero();

    Vec2 Place_m() const { return moment_kgm / kg; }
  };
  struct Carry {
    std::size_t machine, shovel;
    double peak_kg = 0, lowest_kg = 0;  ///< largest load, and the least since then
    Vec2 place_m = Vec2::Zero();        ///< of its load
    std::vector<Loss> losses;

    bool HasDumped() const;
  };
  void Lose(const Instant& before, const Instant& after, double kg, const TerrainSurface& ground,
            Carry* carry) const;
  static Vec2 DumpPlace_m(const Carry& carry);
  /// Appends the spills of a load.
  void Judge(const Carry& carry, std::vector<RecordedEvent>* spills) const;

  Vec2 PlaceOfLoad_m(const Carry& carry, const MachineState& machine) const;
  const Shovel& ShovelOf(const Carry& carry) const;

  const Scenario& scenario_;
  std::vector<Carry> carries_;
  std::vector<RecordedEvent> spills_;
};

}  // namespace tera
