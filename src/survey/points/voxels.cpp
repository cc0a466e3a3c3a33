#include "survey/points/voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace tera {

Voxels GroupByVoxel(const std::vector<Vec3>& p_m, double edge_m) {
  using Key = std::array<std::int64_t, 3>;
  std::vector<Key> keys(p_m.size());
  for (std::size_t k = 0; k < p_m.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      keys[k][2 - axis] =
          static_cast<std::int64_t>(std::floor(p_m[k][static_cast<int>(axis)] / edge_m));
    }
  }
  std::vector<int> order(p_m.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  Voxels voxels;
  voxels.of_point.resize(p_m.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || keys[order[k]] != keys[order[k - 1]]) {
      voxels.count.push_back(0);
      voxels.mean_m.push_back(Vec3::Zero());
    }
    voxels.of_point[order[k]] = static_cast<int>(voxels.count.size()) - 1;
    ++voxels.count.back();
    voxels.mean_m.back() += p_m[order[k]];
  }
  for (std::size_t v = 0; v < voxels.count.size(); ++v) voxels.mean_m[v] /= voxels.count[v];
  return voxels;
}

}  // namespace tera
