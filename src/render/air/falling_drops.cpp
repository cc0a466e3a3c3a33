#include "render/air/falling_drops.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/units.h"

namespace tera {
namespace {

/// Side of each box and the smallest drops in it. At 600 px focal length the smallest drops are
/// about half a pixel wide at the far side.
struct Size {
  double side_m, least_m;
};
constexpr Size kSizes[] = {{1.6, 0.5e-3}, {4.0, 1.0e-3}, {8.0, 2.0e-3}};
constexpr double kNearest_m = 0.15;

/// Ratio of wind speeds at 2 m and 10 m above ground with a roughness of 5 mm.
double LowWindShare() { return std::log(2 / 0.005) / std::log(10 / 0.005); }

}  // namespace

FallingDrops::FallingDrops(const Rain& rain, const Wind& wind) {
  const Vec2 along_mps = LowWindShare() * wind.speed_mps * wind.towards_W();
  for (std::size_t s = 0; s < std::size(kSizes); ++s) {
    const Stream stream(s, "render/rain");
    Shell shell{kSizes[s].side_m, {}};
    const double least_m = kSizes[s].least_m;
    const double most_m = s + 1 < std::size(kSizes) ? kSizes[s + 1].least_m : Rain::kLargest_m;
    const double above = rain.CountAbove_1pm3(least_m), beyond = rain.CountAbove_1pm3(most_m);
    const auto count = std::llround((above - beyond) * std::pow(shell.side_m, 3));
    for (std::int64_t k = 0; k < count; ++k) {
      const auto n = static_cast<std::uint64_t>(k);
      const double share = beyond / above + stream.Uniform(n, 3) * (1 - beyond / above);
      const double diameter_m = rain.DiameterAt(least_m, share);
      const Vec3 p_m =
          shell.side_m * Vec3(stream.Uniform(n, 0), stream.Uniform(n, 1), stream.Uniform(n, 2));
      shell.drops.push_back(
          {p_m, diameter_m, Vec3(along_mps.x(), along_mps.y(), -Rain::FallSpeed_mps(diameter_m))});
    }
    shells_.push_back(std::move(shell));
  }
}

std::vector<FallingDrops::Streak> FallingDrops::Seen(const Pose& X_WC, TimeNs t_ns,
                                                     double exposure_s) const {
  std::vector<Streak> streaks;
  const Mat3 R_CW = X_WC.linear().transpose();
  const double t_s = ToSeconds(t_ns);
  for (const Shell& shell : shells_) {
    for (const Drop& drop : shell.drops) {
      // The periodic copy of the drop nearest to the camera.
      Vec3 p_m = drop.p_m + t_s * drop.v_W_mps - X_WC.translation();
      p_m -= shell.side_m * (p_m / shell.side_m).array().round().matrix();
      if (p_m.squaredNorm() > 0.25 * shell.side_m * shell.side_m) continue;
      const Vec3 middle_C = R_CW * p_m, half_C = 0.5 * exposure_s * (R_CW * drop.v_W_mps);
      const Streak streak{middle_C - half_C, middle_C + half_C, drop.diameter_m};
      if (std::min(streak.from_C_m.z(), streak.to_C_m.z()) < kNearest_m) continue;
      streaks.push_back(streak);
    }
  }
  return streaks;
}

double FallingDrops::Cover(double diameter_px, double width_px, double length_px) {
  return std::min(0.25 * kPi * diameter_px * diameter_px / (width_px * length_px), 1.0);
}

}  // namespace tera
