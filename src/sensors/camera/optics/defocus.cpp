#include "sensors/camera/optics/defocus.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr int kTile_px = 16;
constexpr float kBehind = 1.01f;  // ratio of depths above which a surface counts as behind

/// Kernel number and depth of each pixel; no depth counts as infinite.
struct Discs {
  Image<std::uint16_t> number;
  Image<float> depth_m;
};

Discs DiscsOf(const ThinLens& lens, const Image<float>& depth_m) {
  Discs discs{Image<std::uint16_t>(depth_m.width_px, depth_m.height_px), depth_m};
  for (std::size_t i = 0; i < depth_m.data.size(); ++i) {
    const double radius_px = lens.Radius_px(double(depth_m.data[i]));
    discs.number.data[i] = static_cast<std::uint16_t>(DiscKernels::NumberOf(radius_px));
    if (!(depth_m.data[i] > 0)) discs.depth_m.data[i] = std::numeric_limits<float>::infinity();
  }
  return discs;
}

/// For each tile, the distance within which discs may reach its pixels.
Image<int> LooksOf(const Discs& discs) {
  const int nx = (discs.number.width_px + kTile_px - 1) / kTile_px;
  const int ny = (discs.number.height_px + kTile_px - 1) / kTile_px;
  Image<int> own(nx, ny), look(nx, ny);
  for (int y = 0; y < discs.number.height_px; ++y) {
    for (int x = 0; x < discs.number.width_px; ++x) {
      int& most = own.at(x / kTile_px, y / kTile_px);
      most = std::max(most, DiscKernels::ReachOf(discs.number.at(x, y)));
    }
  }
  const int around = static_cast<int>(ThinLens::kMostRadius_px) / kTile_px + 1;
  for (int b = 0; b < ny; ++b) {
    for (int a = 0; a < nx; ++a) {
      for (int v = std::max(b - around, 0); v <= std::min(b + around, ny - 1); ++v) {
        for (int u = std::max(a - around, 0); u <= std::min(a + around, nx - 1); ++u) {
          const int tiles = std::max(std::abs(u - a), std::abs(v - b));
          const bool reaches = own.at(u, v) > (tiles - 1) * kTile_px;
          if (reaches) look.at(a, b) = std::max(look.at(a, b), own.at(u, v));
        }
      }
    }
  }
  return look;
}

/// Light of a layer, with its coverage of the pixel.
struct Layer {
  Eigen::Vector3f light = Eigen::Vector3f::Zero();
  float cover = 0;

  void Add(float share, const Image<float>& from, int u, int v) {
    light += share * Eigen::Vector3f(from.at(u, v, 0), from.at(u, v, 1), from.at(u, v, 2));
    cover += share;
  }
  Eigen::Vector3f Over(const Eigen::Vector3f& below) const {
    return cover >= 1 ? Eigen::Vector3f(light / cover) : light + (1 - cover) * below;
  }
};

Eigen::Vector3f Gathered(const Discs& discs, const DiscKernels& kernels, const Image<float>& from,
                         int x, int y, int look) {
  const int own = discs.number.at(x, y);
  const float depth_m = discs.depth_m.at(x, y);
  Layer nearer, same, behind;
  const int bottom = std::min(y + look, from.height_px - 1);
  const int right = std::min(x + look, from.width_px - 1);
  for (int v = std::max(y - look, 0); v <= bottom; ++v) {
    for (int u = std::max(x - look, 0); u <= right; ++u) {
      const float there_m = discs.depth_m.at(u, v);
      const bool is_behind = there_m > kBehind * depth_m;
      const float share = kernels.Share(is_behind ? own : discs.number.at(u, v), u - x, v - y);
      if (share == 0) continue;
      Layer& layer = is_behind ? behind : kBehind * there_m < depth_m ? nearer : same;
      layer.Add(share, from, u, v);
    }
  }
  const Eigen::Vector3f surface = same.light / same.cover;
  const Eigen::Vector3f below = behind.cover > 0 ? behind.light / behind.cover : surface;
  return nearer.Over(same.Over(below));
}

}  // namespace

double ThinLens::Radius_px(double depth_m) const {
  const double nearness_1pm = depth_m > 0 ? 1 / depth_m : 0;
  const double radius_m = 0.5 * pupil_m * image_m * std::abs(nearness_1pm - 1 / focus_m);
  return std::min(radius_m / pixel_m, kMostRadius_px);
}

int DiscKernels::NumberOf(double radius_px) {
  return static_cast<int>(std::lround(radius_px * kStepsPerPixel));
}

int DiscKernels::ReachOf(int number) {
  // Pixel k receives light if k - 1/2 < radius.
  return number == 0 ? 0 : static_cast<int>(std::ceil(double(number) / kStepsPerPixel + 0.5)) - 1;
}

DiscKernels::DiscKernels(double most_radius_px) {
  for (int number = 0; number <= NumberOf(most_radius_px); ++number) {
    const int side = ReachOf(number) + 1;
    // Light spread over a pixel has a variance of 1 / 12 per axis, a disc has radius^2 / 4.
    const double radius_px = std::sqrt(
        std::max(double(number * number) / (kStepsPerPixel * kStepsPerPixel) - 1.0 / 3, 0.0));
    std::vector<float> quarter(static_cast<std::size_t>(side) * side, 0);
    double sum = 0;
    for (int dy = 0; dy < side; ++dy) {
      for (int dx = 0; dx < side; ++dx) {
        int inside = 0;
        for (int k = 0; k < kParts * kParts; ++k) {
          const double x = dx - 0.5 + (k % kParts + 0.5) / kParts;
          const double y = dy - 0.5 + (k / kParts + 0.5) / kParts;
          inside += x * x + y * y <= radius_px * radius_px;
        }
        quarter[static_cast<std::size_t>(dy) * side + dx] = static_cast<float>(inside);
        sum += inside * (dx > 0 ? 2 : 1) * (dy > 0 ? 2 : 1);
      }
    }
    if (sum > 0) {
      for (float& share : quarter) share /= static_cast<float>(sum);
    } else {
      quarter.front() = 1;  // smaller than the parts of a pixel
    }
    quarters_.push_back(std::move(quarter));
  }
}

float DiscKernels::Share(int number, int dx_px, int dy_px) const {
  const int side = ReachOf(number) + 1;
  const int dx = std::abs(dx_px), dy = std::abs(dy_px);
  if (dx >= side || dy >= side) return 0;
  return quarters_[static_cast<std::size_t>(number)][static_cast<std::size_t>(dy) * side + dx];
}

Image<float> Defocused(const ThinLens& lens, const DiscKernels& kernels,
                       const Image<float>& depth_m, const Image<float>& luminance_cdpm2) {
  const Discs discs = DiscsOf(lens, depth_m);
  const Image<int> looks = LooksOf(discs);
  Image<float> blurred(luminance_cdpm2.width_px, luminance_cdpm2.height_px, 3);
  for (int y = 0; y < blurred.height_px; ++y) {
    for (int x = 0; x < blurred.width_px; ++x) {
      const int look = looks.at(x / kTile_px, y / kTile_px);
      const Eigen::Vector3f light = Gathered(discs, kernels, luminance_cdpm2, x, y, look);
      for (int c = 0; c < 3; ++c) blurred.at(x, y, c) = light[c];
    }
  }
  return blurred;
}

}  // namespace tera
