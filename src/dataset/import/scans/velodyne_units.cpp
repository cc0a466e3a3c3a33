#include "dataset/import/scans/velodyne_units.h"

namespace tera {
namespace {

constexpr double kFiring_us = 2.304;

/// Firing times if groups of `at_once` lasers fire together, one group after another.
std::vector<double> FiringTimes(int lasers, int at_once) {
  std::vector<double> times_us;
  for (int n = 0; n < lasers; ++n) times_us.push_back(kFiring_us * (n / at_once));
  return times_us;
}

}  // namespace

const VelodyneUnit& Vlp16() {
  static const VelodyneUnit unit{
      .name = "VLP-16",
      .factory_byte = 0x22,
      .range_step_m = 0.002,
      .sequences_per_block = 2,
      .elevation_deg = {-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15},
      .azimuth_offset_deg = std::vector<double>(16, 0.0),
      .origin_z_m = {0.0112, -0.0007, 0.0097, -0.0022, 0.0081, -0.0037, 0.0066, -0.0051, 0.0051,
                     -0.0066, 0.0037, -0.0081, 0.0022, -0.0097, 0.0007, -0.0112},
      .firing_us = FiringTimes(16, 1)};
  return unit;
}

const VelodyneUnit& Vlp32c() {
  static const VelodyneUnit unit{
      .name = "VLP-32C",
      .factory_byte = 0x28,
      .range_step_m = 0.004,
      .sequences_per_block = 1,
      .elevation_deg = {-25,    -1,    -1.667, -15.639, -11.31, 0,     -0.667, -8.843,
                        -7.254, 0.333, -0.333, -6.148,  -5.333, 1.333, 0.667,  -4,
                        -4.667, 1.667, 1,      -3.667,  -3.333, 3.333, 2.333,  -2.667,
                        -3,     7,     4.667,  -2.333,  -2,     15,    10.333, -1.333},
      .azimuth_offset_deg = {1.4,  -4.2, 1.4,  -1.4, 1.4,  -1.4, 4.2,  -1.4, 1.4,  -4.2, 1.4,
                             -1.4, 4.2,  -1.4, 4.2,  -1.4, 1.4,  -4.2, 1.4,  -4.2, 4.2,  -1.4,
                             1.4,  -1.4, 1.4,  -1.4, 1.4,  -4.2, 4.2,  -1.4, 1.4,  -1.4},
      .origin_z_m = std::vector<double>(32, 0.0),
      .firing_us = FiringTimes(32, 2)};
  return unit;
}

}  // namespace tera
