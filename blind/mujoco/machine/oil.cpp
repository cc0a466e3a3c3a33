#include "blind/mujoco/machine/oil.h"

namespace tera::blind::mujoco {

std::array<OilNumbers, 6> OilOf(const std::string& kind) {
  if (kind != "excavator2t") return {};
  const OilNumbers track{65, 0.45};
  return {track, track, {48, 0.35}, {56, 0.28}, {66, 0.32}, {88, 0.42}};
}

}  // namespace tera::blind::mujoco
