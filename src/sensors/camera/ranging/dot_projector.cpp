#include "sensors/camera/ranging/dot_projector.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kSameDepth = 0.02;  // relative tolerance of depth on the projector's line of sight
constexpr double kLeast_lx = 1e-4;   // scene light below which reflectance is undetermined
constexpr int kParts = 3;            // parts of a pixel per axis

/// True if a point in P has a free line of sight to the projector.
bool Reaches(const LitEye& eye, const Vec3& p_P_m) {
  if (p_P_m.z() <= eye.camera.near_m) return false;
  const Vec2 pixel_px = eye.camera.Project(p_P_m);
  const int x = static_cast<int>(std::lround(pixel_px.x()));
  const int y = static_cast<int>(std::lround(pixel_px.y()));
  if (x < 0 || y < 0 || x >= eye.camera.width_px || y >= eye.camera.height_px) return false;
  const double first_m = double(eye.from_P_m.at(x, y));
  return first_m == 0 || p_P_m.z() < (1 + kSameDepth) * first_m;
}

/// Mean of the pattern over the area of a pixel.
double PatternOver(const DotPattern& pattern, const LitEye& eye, int x, int y, double depth_m) {
  double sum = 0;
  for (int k = 0; k < kParts * kParts; ++k) {
    const Vec2 at_px(x - 0.5 + (k % kParts + 0.5) / kParts, y - 0.5 + (k / kParts + 0.5) / kParts);
    const Vec3 p_P_m = eye.X_PE * (depth_m * eye.camera.Unproject(at_px));
    if (p_P_m.z() > 0) sum += pattern.At(p_P_m.head<2>() / p_P_m.z());
  }
  return sum / (kParts * kParts);
}

}  // namespace

void Serialize(ModelArchive* archive, DotProjector* m) {
  archive->Need("intensity_cd", &m->intensity_cd, Positive("cd"));
  archive->Visit("cell_deg", &m->cell_deg, Between(0.05, 10, "deg"));
  archive->Visit("dot_share", &m->dot_share, Between(0.02, 0.5, "1"));
}

DotPattern::DotPattern(const DotProjector& projector, const Stream& draw)
    : cell_(projector.cell_deg * kDeg),
      share_(projector.dot_share),
      side_(2 * static_cast<int>(std::ceil(kWidest / cell_)) + 3) {
  for (int k = 0; k < side_ * side_; ++k) {
    const auto number = static_cast<std::uint64_t>(k);
    dots_.emplace_back(k % side_ + draw.Uniform(number, 0), k / side_ + draw.Uniform(number, 1));
  }
}

double DotPattern::At(const Vec2& tangent) const {
  constexpr double kReach = 4;  // reach of a dot, in standard deviations
  const Vec2 at = tangent / cell_ + Vec2::Constant(0.5 * side_);
  const int column = static_cast<int>(std::floor(at.x())),
            row = static_cast<int>(std::floor(at.y()));
  if (column < 1 || row < 1 || column > side_ - 2 || row > side_ - 2) return 0;
  double sum = 0;
  for (int j = row - 1; j <= row + 1; ++j) {
    for (int i = column - 1; i <= column + 1; ++i) {
      const double away2 =
          (at - dots_[static_cast<std::size_t>(j) * side_ + i]).squaredNorm() / (share_ * share_);
      if (away2 < kReach * kReach) sum += std::exp(-0.5 * away2);
    }
  }
  return sum;
}

double MeteredWhite_cdpm2(const Rasterizer& rasterizer) {
  return 1.2 * std::exp2(rasterizer.model().environment.exposure_ev100);
}

void AddDots(const DotProjector& projector, const DotPattern& pattern, const LitEye& eye,
             Image<float>* luminance_cdpm2) {
  for (int y = 0; y < eye.camera.height_px; ++y) {
    for (int x = 0; x < eye.camera.width_px; ++x) {
      const double depth_m = double(eye.depth_m.at(x, y)), lux = double(eye.lux_share.at(x, y, 0));
      if (!(depth_m > 0) || lux < kLeast_lx) continue;
      const Vec3 p_P_m = eye.X_PE * (depth_m * eye.camera.Unproject(Vec2(x, y)));
      if (!Reaches(eye, p_P_m)) continue;
      const double dots_lx =
          projector.intensity_cd / p_P_m.squaredNorm() * PatternOver(pattern, eye, x, y, depth_m);
      luminance_cdpm2->at(x, y) *= static_cast<float>(1 + dots_lx / lux);
    }
  }
}

}  // namespace tera
