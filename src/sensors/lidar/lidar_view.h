#pragma once

#include "sensors/lidar/lidar.h"
#include "sensors/view_field.h"

namespace tera {

/// Field of view of a lidar.
///
/// Model   beams at elevations e_i and n columns yield 1 / ((sin e+ - sin e-) 2 pi / n) points per
///         steradian per revolution; e- and e+ are the midpoints to the neighbouring beams. A
///         surface that returns the fraction q of the light is visible up to
///         RangeEquation::Reach_m(q), r10 sqrt(q / 0.1) of a thin ray, in clear air. Glass returns
///         points and hides the surfaces behind it (RayScene). Beams of a single elevation span no
///         solid angle: such a field is flat. A pattern's density is the mean over its first
///         million pulses, in cells of 2 deg.
/// Omits   azimuth offsets of single beams, which shift points without a change in density.
/// Source  radar equation as in Lidar.
ViewField ViewOf(const LidarModel& model, double rate_hz);

/// Range up to which a pulse returns a surface through fog, rain or falling snow.
///
/// Model   `returned` exp(-2 a r) reaches RangeEquation::LeastSurface(r), with the extinction a of
///         AirEchoes. Dense fog can itself be detected at the nearest range, half a pulse beyond
///         `min_range_m`. A beam with one return then reports the surface only if its echo is
///         stronger than that of the fog; with `pick: first` it never does, with `last` always. A
///         beam with more returns reports both.
/// Omits   dust, drops and flakes that return in place of the surface, noise of the fog's echo.
/// Source  as Lidar and AirEchoes.
double ReachInAir_m(const LidarModel& model, const SensedAir& air, double returned);

}  // namespace tera
