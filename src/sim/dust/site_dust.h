#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
#include "render/air/dust_volume.h"
#include "sim/dust/dust_field.h"
#include "sim/dust/dust_sources.h"

namespace tera {

/// Airborne dust of a scenario: one field, raised by the work and seen by all sensors. It depends
/// only on the motion and the ground, so a playback of the scene reproduces it.
///
/// Frames  W.
/// Model   a square of air around the machines' mean position at the start, above the ground at
///         that time. DustSources emits, scaled by `emission_factor`. DustField transports, in
///         steps of kStep_ns.
///         Gusts are Ornstein-Uhlenbeck processes along and across the wind with the time constant
///         kGust_s. Their standard deviations are 2.4 and 1.9 times the friction velocity.
///         DustEddies adds fluctuations below the cell size to the optical field.
/// Source  Panofsky and Dutton 1984, Atmospheric Turbulence, section 7.4 (standard deviations in
///         the neutral surface layer).
class SiteDust {
 public:
  static constexpr TimeNs kStep_ns = 40 * kNsPerSecond / 1000;
  static constexpr double kGust_s = 4;

  /// Keeps a reference to `scenario`, which must have dust.
  SiteDust(const Scenario& scenario, const Instant& start, const TerrainSurface& ground);
  /// Advances by one physics step.
  void Step(const WorldStep& step);

  /// The optical field after the last step of kStep_ns.
  const DustVolume& volume() const;
  const DustField& field() const { return field_; }

 private:
  Vec2 Gust(double dt_s);

  const Scenario& scenario_;
  DustSources sources_;
  DustField field_;
  Stream gusts_;
  Vec2 gust_along_mps_ = Vec2::Zero();  ///< along and across the wind
  Vec3 eddies_mps_;
  std::uint64_t steps_ = 0;
  TimeNs stepped_ns_;
  std::vector<DustPuff> puffs_;
  mutable DustVolume volume_;
  mutable bool is_current_ = false;
};

}  // namespace tera
