#pragma once

namespace tera {

/// Expected deviations of the faultless recordings, in SI units. Scales and a unit's mount are from
/// docs/reference/diagnose.md.
struct UsualTolerances {
  double gyro_bias_radps = 0.002, accel_bias_mps2 = 0.04;
  double gyro_scale = 0.02, accel_scale = 0.01;
  double unit_mount_rad = 0.008, unit_place_m = 0.05;
  double antenna_place_m = 0.025, pair_heading_rad = 0.05;
  double reflected_m = 0.024;
  double stamps_s = 0.04;
  double encoder_zero_rad = 0.003, encoder_scale = 0.01;
  double datum_m = 0.04;
  double pose_tilt_rad = 0.02, pose_heading_rad = 0.05;
};

}  // namespace tera
