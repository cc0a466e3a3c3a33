#pragma once

#include <array>

#include "render/air/dust_volume.h"

namespace tera::testing {

/// Even dust in a box of cells from `low_W_m` on, without eddies.
inline DustVolume DustBox(const Vec3& low_W_m, double cell_m, const std::array<int, 3>& cells,
                          double extinction_1pm) {
  DustVolume dust;
  dust.origin_W_m = low_W_m.head<2>();
  dust.cell_m = cell_m;
  dust.nx = cells[0], dust.ny = cells[1], dust.nz = cells[2];
  dust.base_m.assign(static_cast<std::size_t>(dust.nx) * dust.ny, static_cast<float>(low_W_m.z()));
  dust.extinction_1pm.assign(static_cast<std::size_t>(dust.nx) * dust.ny * dust.nz,
                             static_cast<float>(extinction_1pm));
  const Vec3 half_m = Vec3::Constant(0.5 * cell_m);
  dust.occupied_W_m.extend(Vec3(low_W_m - half_m));
  dust.occupied_W_m.extend(Vec3(low_W_m + cell_m * Vec3(dust.nx, dust.ny, dust.nz) + half_m));
  dust.version = 1;
  return dust;
}

}  // namespace tera::testing
