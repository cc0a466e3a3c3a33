#pragma once

namespace tera {

/// Spoil that was dumped, seen from the slew axis.
struct SpoilHeap {
  double azimuth_rad = 0, r_m = 0;  ///< of its top
  double height_m = 0;              ///< that the ground rose by there; none where it did not
};

/// A cut along a radius, from where the teeth enter inwards.
struct RadialCut {
  double azimuth_rad = 0;
  double reach_m = 0, length_m = 0;
};

/// Whether a cut comes over the heap, whose foot lies as far out as at a slope of 30 deg, the
/// shallowest repose of the shipped soils.
bool IsInHeap(const RadialCut& cut, const SpoilHeap& heap);

/// The azimuth of the next cut, `step_rad` further round: nobody digs in what he has dumped, so
/// that places in the heap are passed over. Where all of a turn are, the next one is taken.
double NextDigAzimuth_rad(const RadialCut& cut, double step_rad, const SpoilHeap& heap);

}  // namespace tera
