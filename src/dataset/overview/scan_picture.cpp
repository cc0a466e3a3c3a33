#include "dataset/overview/scan_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/quantile.h"
#include "core/units.h"

namespace tera {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour kBackground = {12, 12, 16}, kUnknownClass = {255, 255, 255};
constexpr double kShareInView = 0.98;  ///< fraction of the points within the view from above
constexpr double kRingStep_m = 10.0, kMinRadius_m = 10.0;

Colour ClassColour(std::uint8_t label) {
  return label < kSemanticClasses.size() ? kSemanticClasses[label].rgb : kUnknownClass;
}

/// Draws a square of `size_px`, unless it crosses the border.
void Dot(double x_px, double y_px, int size_px, const Colour& colour, Picture* picture) {
  const int x = static_cast<int>(std::floor(x_px)), y = static_cast<int>(std::floor(y_px));
  if (x < 0 || y < 0 || x + size_px > picture->width_px || y + size_px > picture->height_px) return;
  for (int v = y; v < y + size_px; ++v) {
    for (int u = x; u < x + size_px; ++u) {
      std::copy(colour.begin(), colour.end(),
                picture->data.begin() + 3 * (std::ptrdiff_t{v} * picture->width_px + u));
    }
  }
}

Picture Empty(int width_px, int height_px) {
  Picture picture(width_px, height_px, 3);
  for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = kBackground[i % 3];
  return picture;
}

/// Camera of the view from behind, in the sensor frame. It is close enough to show the machine
/// below a roof lidar, and high enough to show the ground around it.
struct ObliqueView {
  Vec3 eye_S_m{-7.0, -6.5, 6.0};
  Vec3 target_S_m{4.0, 1.5, 0.0};
  double horizontal_fov_rad = 68 * kDeg;
  double near_m = 1.0;

  Mat3 R_CS() const {
    const Vec3 z = (target_S_m - eye_S_m).normalized();
    const Vec3 x = z.cross(Vec3::UnitZ()).normalized();
    Mat3 R;
    R << x.transpose(), z.cross(x).transpose(), z.transpose();
    return R;
  }
};

/// Colour of a class, darker for weaker returns. It is full at intensity 1.
Colour Shaded(const LidarPoint& p) {
  const double bright = 0.5 + 0.5 * std::sqrt(std::clamp(double(p.intensity), 0.0, 1.0));
  Colour colour = ClassColour(p.label);
  for (std::uint8_t& c : colour) c = static_cast<std::uint8_t>(std::lround(bright * c));
  return colour;
}

}  // namespace

double ShownRadius_m(const std::vector<LidarPoint>& points) {
  std::vector<double> ranges_m;
  for (const LidarPoint& p : points) ranges_m.push_back(std::hypot(p.x_m, p.y_m));
  if (ranges_m.empty()) return kMinRadius_m;
  return std::max(kMinRadius_m, Quantile(std::move(ranges_m), kShareInView));
}

Picture DrawScanFromAbove(const std::vector<LidarPoint>& points, int width_px, int height_px) {
  return DrawScanFromAbove(points, width_px, height_px, ShownRadius_m(points));
}

Picture DrawScanFromAbove(const std::vector<LidarPoint>& points, int width_px, int height_px,
                          double radius_m) {
  Picture picture = Empty(width_px, height_px);
  cv::Mat canvas(height_px, width_px, CV_8UC3, picture.data.data());
  const double px_per_m = 0.5 * std::min(width_px, height_px) / radius_m;
  const cv::Point2d centre(0.5 * width_px, 0.5 * height_px);
  for (double ring_m = kRingStep_m; ring_m * px_per_m < width_px; ring_m += kRingStep_m) {
    cv::circle(canvas, centre, static_cast<int>(ring_m * px_per_m), cv::Scalar(60, 60, 70), 1,
               cv::LINE_AA);
  }
  for (const LidarPoint& p : points) {
    Dot(centre.x - px_per_m * double(p.y_m), centre.y - px_per_m * double(p.x_m), 2,
        ClassColour(p.label), &picture);
  }
  cv::arrowedLine(canvas, centre, centre - cv::Point2d(0, 2 * px_per_m), cv::Scalar(255, 255, 255),
                  2, cv::LINE_AA);
  return picture;
}

Picture DrawScanFromBehind(const std::vector<LidarPoint>& points, int width_px, int height_px) {
  const ObliqueView view;
  const Mat3 R_CS = view.R_CS();
  const double focal_px = 0.5 * width_px / std::tan(0.5 * view.horizontal_fov_rad);
  struct Placed {
    Vec3 p_C_m;
    Colour colour;
  };
  std::vector<Placed> placed;
  for (const LidarPoint& p : points) {
    const Vec3 p_C_m = R_CS * (Vec3(p.x_m, p.y_m, p.z_m) - view.eye_S_m);
    if (p_C_m.z() > view.near_m) placed.push_back({p_C_m, Shaded(p)});
  }
  // Draws far points first, so that near points cover them.
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.p_C_m.z() > b.p_C_m.z(); });
  Picture picture = Empty(width_px, height_px);
  constexpr double kNear_m = 14.0;  // up to this distance, dots are larger
  for (const Placed& point : placed) {
    const Vec3& p = point.p_C_m;
    Dot(0.5 * width_px + focal_px * p.x() / p.z(), 0.5 * height_px + focal_px * p.y() / p.z(),
        p.z() < kNear_m ? 3 : 2, point.colour, &picture);
  }
  return picture;
}

}  // namespace tera
