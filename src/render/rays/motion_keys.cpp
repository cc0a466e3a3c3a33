#include "render/rays/motion_keys.h"

#include <algorithm>
#include <cmath>

#include "render/rays/embree_objects.h"

namespace tera {
namespace {

/// Largest rotation between two motion keys. The chord between them then stays within r * 0.01^2 /
/// 8 of the arc: 0.05 mm at r = 4 m.
constexpr double kKeyTurn_rad = 0.01;

}  // namespace

std::vector<Pose> MotionKeys(const std::vector<std::vector<Pose>>& poses, std::size_t body) {
  std::vector<Pose> keys;
  double turn = 0;
  bool moves = false;
  for (const std::vector<Pose>& at : poses) {
    if (!keys.empty()) {
      moves = moves || keys.back().matrix() != at[body].matrix();
      turn = std::max(turn, Quat(keys.back().linear()).angularDistance(Quat(at[body].linear())));
    }
    keys.push_back(at[body]);
  }
  if (!moves) return {keys.front()};
  const int intervals = static_cast<int>(keys.size()) - 1;
  const int most = (RTC_MAX_TIME_STEP_COUNT - 1) / intervals;
  const int pieces = std::clamp(static_cast<int>(std::ceil(turn / kKeyTurn_rad)), 1, most);
  std::vector<Pose> fine;
  for (int i = 0; i < intervals; ++i) {
    for (int k = 0; k < pieces; ++k) {
      fine.push_back(Interpolate(keys[i], keys[i + 1], static_cast<double>(k) / pieces));
    }
  }
  fine.push_back(keys.back());
  return fine;
}

}  // namespace tera
