#pragma once

namespace tera {

/// Half widths within which 95 % of machines are that nobody would call wrong: what an owner
/// expects of sensors that were mounted, wired and read with ordinary care.
///
/// Source  the tolerances that the owner of the recordings in which nothing is wrong states
///         (docs/proof.md); scales by data sheets of industrial units.
struct SensorTolerances {
  double gyro_bias_radps = 0.002, accel_bias_mps2 = 0.04;
  double gyro_scale = 0.02, accel_scale = 0.01;
  double unit_mount_rad = 0.008, unit_place_m = 0.05;
  double antenna_place_m = 0.025, pair_heading_rad = 0.05;
  double stamps_s = 0.04;             ///< between a sensor and the encoders, delays and filters
  double reference_stamps_s = 0.005;  ///< of the encoders, to which all other stamps are compared
  double encoder_zero_rad = 0.003, encoder_scale = 0.01;
  double datum_m = 0.04;
  double pose_place_m = 0.04, pose_tilt_rad = 0.02, pose_heading_rad = 0.05;
};

}  // namespace tera
