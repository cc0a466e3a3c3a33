#include "diagnose/perception/pictures/picture_registration.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

/// The constant c of PictureLevels, on a scale of 0 to 1, suppresses areas with less contrast.
constexpr double kLeastSpread = 0.05;
constexpr double kWindowShare = 0.05;  ///< window for mean and variance, over the picture's width

/// Moving average of `count` values at a distance of `stride`. Each result is the mean of a value
/// and `reach` neighbours on either side. The first and last values are repeated beyond the ends.
void SlideMean(const float* from, float* to, int count, int stride, int reach) {
  const auto at = [&](int i) { return from[std::clamp(i, 0, count - 1) * stride]; };
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += at(i);
  for (int i = 0; i < count; ++i) {
    to[i * stride] = static_cast<float>(sum / (2 * reach + 1));
    sum += at(i + reach + 1) - at(i - reach);
  }
}

/// Brightness minus its local mean, divided by its local spread.
Image<float> WithoutExposure(const Image<float>& grey) {
  const double window_px = kWindowShare * grey.width_px;
  const Image<float> mean = Blurred(grey, window_px);
  Image<float> square(grey.width_px, grey.height_px);
  for (std::size_t i = 0; i < grey.data.size(); ++i) {
    const float off = grey.data[i] - mean.data[i];
    square.data[i] = off * off;
  }
  const Image<float> variance = Blurred(square, window_px);
  Image<float> plain(grey.width_px, grey.height_px);
  for (std::size_t i = 0; i < grey.data.size(); ++i) {
    const double spread = std::sqrt(variance.data[i] + kLeastSpread * kLeastSpread);
    plain.data[i] = static_cast<float>((grey.data[i] - mean.data[i]) / spread);
  }
  return plain;
}

}  // namespace

Image<float> Blurred(const Image<float>& picture, double sigma_px) {
  // Three windows of width 2 r + 1 have the total variance r (r + 1).
  const int reach = std::max(
      1, static_cast<int>(std::lround(0.5 * (std::sqrt(1 + 4 * sigma_px * sigma_px) - 1))));
  Image<float> from = picture, to(picture.width_px, picture.height_px);
  for (int pass = 0; pass < 3; ++pass) {
    for (int y = 0; y < picture.height_px; ++y) {
      SlideMean(&from.at(0, y), &to.at(0, y), picture.width_px, 1, reach);
    }
    std::swap(from, to);
    for (int x = 0; x < picture.width_px; ++x) {
      SlideMean(&from.at(x, 0), &to.at(x, 0), picture.height_px, picture.width_px, reach);
    }
    std::swap(from, to);
  }
  return from;
}

PictureLevels::PictureLevels(const Image<float>& grey) {
  TERA_CHECK(std::min(grey.width_px, grey.height_px) >= kSmallest_px, grey.width_px,
             grey.height_px);
  const Image<float> plain = WithoutExposure(grey);
  for (int level = 0; level < kCount; ++level) {
    levels_[static_cast<std::size_t>(level)] = Blurred(plain, std::pow(2.0, level));
  }
}

float PictureLevels::At(int level, const Vec2& px) const {
  const Image<float>& picture = levels_[static_cast<std::size_t>(level)];
  const double x = std::clamp(px.x(), 0.0, picture.width_px - 1.001);
  const double y = std::clamp(px.y(), 0.0, picture.height_px - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const auto a = static_cast<float>(x - i), b = static_cast<float>(y - j);
  const float upper = (1 - a) * picture.at(i, j) + a * picture.at(i + 1, j);
  const float lower = (1 - a) * picture.at(i, j + 1) + a * picture.at(i + 1, j + 1);
  return (1 - b) * upper + b * lower;
}

Vec2 PictureLevels::GradientAt(int level, const Vec2& px) const {
  return 0.5 * Vec2(At(level, px + Vec2::UnitX()) - At(level, px - Vec2::UnitX()),
                    At(level, px + Vec2::UnitY()) - At(level, px - Vec2::UnitY()));
}

bool PictureLevels::Holds(const Vec2& px) const {
  const Image<float>& picture = levels_.front();
  const Vec2 last(picture.width_px - 2, picture.height_px - 2);
  return (px.array() >= 1).all() && (px.array() <= last.array()).all();
}

namespace {

constexpr double kSquareShare = 1.0 / 30;  ///< side of a square, over the picture's width
constexpr double kBorderShare = 0.02;      ///< margin without landmarks, over the picture's width
constexpr double kLeastGradient = 0.08;    ///< least gradient of normalised brightness, per pixel
constexpr double kLeastEdge = 1e-3;        ///< least divisor of a residual, per pixel
/// Standard deviations of normalised brightness, of an edge's position, and of a camera shift at
/// each level.
constexpr double kBrightnessSigma = 0.1, kPlaceSigma_px = 0.2;
constexpr double kShiftSigma_m[PictureLevels::kCount] = {0, 0.02, 0.05, 0.1};
constexpr double kDifference_m = 1e-5;  ///< step for derivatives of the projection
constexpr double kNearest_m = 0.05;     ///< least depth at which the camera sees
/// Distance of compared points from the edge's centre. At the centre, brightness does not depend on
/// the direction of the edge.
constexpr double kSideOfEdge_px = 1.5;

/// Nearest depth among a pixel and its eight neighbours; 0 if none has a depth.
double ForegroundDepth_m(const Image<float>& depth_m, int x, int y) {
  double nearest_m = 0;
  for (int b = y - 1; b <= y + 1; ++b) {
    for (int a = x - 1; a <= x + 1; ++a) {
      const double z_m = depth_m.at(a, b);
      if (z_m > 0 && (nearest_m == 0 || z_m < nearest_m)) nearest_m = z_m;
    }
  }
  return nearest_m;
}

/// Surface of a pixel. A machine or an obstacle among its neighbours takes precedence over ground.
/// Returns nothing if one of them is not comparable.
std::optional<Surface> SurfaceAt(const SimulatedPicture& picture, int x, int y) {
  Surface found = Surface::kGround;
  for (int b = y - 1; b <= y + 1; ++b) {
    for (int a = x - 1; a <= x + 1; ++a) {
      const auto surface = static_cast<Surface>(picture.surface.at(a, b));
      if (surface == Surface::kUnknown) return std::nullopt;
      if (surface == Surface::kMachine || surface == Surface::kObstacle) found = surface;
    }
  }
  return found;
}

/// Pixel of a square with the steepest brightness. Returns nothing if it is too flat.
std::optional<Vec2> SteepestIn(const PictureLevels& levels, int level, int left, int top,
                               int size) {
  std::optional<Vec2> px;
  double steepest = kLeastGradient * std::pow(0.5, level);
  for (int y = top; y < top + size; ++y) {
    for (int x = left; x < left + size; ++x) {
      const double gradient = levels.GradientAt(level, Vec2(x, y)).norm();
      if (gradient <= steepest) continue;
      steepest = gradient;
      px = Vec2(x, y);
    }
  }
  return px;
}

}  // namespace

PictureRegistration::PictureRegistration(const PictureSource& source,
                                         const SensorCalibration& calibration)
    : source_(source), squares_(source.t_ns.size()) {
  for (std::size_t f = 0; f < source.t_ns.size(); ++f) {
    measured_.emplace_back(source.grey[f]);
    const auto simulated = source.render(f, calibration);
    const auto link = source.link_at(f, calibration);
    if (simulated && link) AddLandmarks(f, *simulated, *link, calibration);
  }
}

std::optional<PictureRegistration::Landmark> PictureRegistration::LandmarkAt(
    const SimulatedPicture& simulated, const BodyState& link, const SensorCalibration& calibration,
    const Vec2& px) const {
  const int x = static_cast<int>(px.x()), y = static_cast<int>(px.y());
  const double depth_m = ForegroundDepth_m(simulated.depth_m, x, y);
  const auto surface = SurfaceAt(simulated, x, y);
  const auto ray = source_.ray(px);
  if (!(depth_m > 0) || !surface || !ray) return std::nullopt;
  Landmark landmark;
  landmark.surface = *surface;
  const Vec3 p_T_m = source_.X_SC * Vec3(depth_m * *ray);
  landmark.p_m = calibration.X_BT * p_T_m;
  if (*surface != Surface::kMachine) landmark.p_m = link.X_WB * landmark.p_m;
  return landmark;
}

void PictureRegistration::AddLandmarks(std::size_t frame, const SimulatedPicture& simulated,
                                       const BodyState& link,
                                       const SensorCalibration& calibration) {
  const PictureLevels levels(simulated.grey);
  const int width = simulated.grey.width_px, height = simulated.grey.height_px;
  const int size = std::max(4, static_cast<int>(kSquareShare * width));
  const int border = std::max(2, static_cast<int>(kBorderShare * width));
  for (int top = border; top + size <= height - border; top += size) {
    for (int left = border; left + size <= width - border; left += size) {
      Square square;
      for (int k = 0; k < PictureLevels::kCount; ++k) {
        const auto px = SteepestIn(levels, k, left, top, size);
        if (!px) continue;
        auto& landmark = square[static_cast<std::size_t>(k)];
        landmark = LandmarkAt(simulated, link, calibration, *px);
        if (!landmark) continue;
        landmark->value = levels.At(k, *px);
        landmark->gradient = levels.GradientAt(k, *px);
      }
      if (square[0]) squares_[frame].push_back(square);
    }
  }
}

std::vector<ScanPoints> PictureRegistration::PointsOf(const ScanSplit& split,
                                                      const std::vector<Part>& parts) const {
  std::vector<ScanPoints> chosen;
  for (std::size_t f = 0; f < squares_.size(); ++f) {
    if (std::find(parts.begin(), parts.end(), split.part[f]) == parts.end()) continue;
    ScanPoints of_frame{f, {}};
    for (std::size_t p = 0; p < squares_[f].size(); ++p) of_frame.points.push_back(p);
    chosen.push_back(std::move(of_frame));
  }
  return chosen;
}

std::optional<PictureRegistration::Projection> PictureRegistration::Project(
    const Landmark& landmark, const BodyState& link, const SensorCalibration& calibration) const {
  const bool moves_along = landmark.surface == Surface::kMachine;
  const Vec3 p_B_m = moves_along ? landmark.p_m : Vec3(link.X_WB.inverse() * landmark.p_m);
  const Vec3 r_B_m = p_B_m - calibration.X_BT.translation();
  const Mat3 R_TB = calibration.X_BT.linear().transpose();
  const Pose X_CT = source_.X_SC.inverse();
  const Vec3 p_C_m = X_CT * Vec3(R_TB * r_B_m);
  if (p_C_m.z() < kNearest_m) return std::nullopt;
  Projection projection;
  projection.px = source_.project(p_C_m);
  Eigen::Matrix<double, 2, 3> by_C;
  for (int a = 0; a < 3; ++a) {
    const Vec2 moved_px = source_.project(p_C_m + kDifference_m * Vec3::Unit(a));
    by_C.col(a) = (moved_px - projection.px) / kDifference_m;
  }
  const Eigen::Matrix<double, 2, 3> by_B = by_C * X_CT.linear() * R_TB;
  projection.by_calibration.middleCols<3>(kShiftOfMount) = -by_B;
  for (int a = 0; a < 3; ++a) {
    // A rotation of the camera moves the point in the opposite direction.
    projection.by_calibration.col(kTurnOfMount + a) = by_B * r_B_m.cross(Vec3::Unit(a));
  }
  if (!moves_along) {
    // A clock that is ahead stamps a picture with a time after its exposure.
    const Vec3 v_W_mps =
        link.v_WB_mps + link.w_WB_radps.cross(landmark.p_m - link.X_WB.translation());
    projection.by_calibration.col(kClockOffset) = by_B * (link.X_WB.linear().transpose() * v_W_mps);
  }
  return projection;
}

std::vector<PointResidual> PictureRegistration::ResidualsOf(const std::vector<ScanPoints>& points,
                                                            const SensorCalibration& calibration,
                                                            int level) const {
  const auto k = static_cast<std::size_t>(level);
  std::vector<PointResidual> residuals;
  for (const ScanPoints& of_frame : points) {
    const auto link = source_.link_at(of_frame.scan, calibration);
    for (const std::size_t p : of_frame.points) {
      const std::optional<Landmark>& landmark = squares_[of_frame.scan][p][k];
      PointResidual residual;
      residual.scan = of_frame.scan;
      const auto seen = link && landmark ? Project(*landmark, *link, calibration) : std::nullopt;
      const PictureLevels& measured = measured_[of_frame.scan];
      residual.out_of_picture = seen && !measured.Holds(seen->px);
      if (seen && !residual.out_of_picture) {
        const double steep = std::max(kLeastEdge, landmark->gradient.norm());
        const Vec2 gradient = 0.5 * (landmark->gradient + measured.GradientAt(level, seen->px));
        residual.surface = landmark->surface;
        residual.distance = (measured.At(level, seen->px) - landmark->value) / steep;
        const double parallax_pxpm =
            seen->by_calibration.middleCols<3>(kShiftOfMount).norm() / std::sqrt(2.0);
        residual.sigma = std::hypot(kBrightnessSigma / steep, kPlaceSigma_px,
                                    kShiftSigma_m[level] * parallax_pxpm);
        residual.by_calibration = seen->by_calibration.transpose() * gradient / steep;
      }
      residuals.push_back(residual);
    }
  }
  return residuals;
}

double PictureRegistration::Correlation(const std::vector<ScanPoints>& points,
                                        const SensorCalibration& calibration) const {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (const ScanPoints& of_frame : points) {
    const auto link = source_.link_at(of_frame.scan, calibration);
    if (!link) continue;
    for (const std::size_t p : of_frame.points) {
      const Landmark& landmark = *squares_[of_frame.scan][p][0];
      const auto seen = Project(landmark, *link, calibration);
      if (!seen) continue;
      const PictureLevels& measured = measured_[of_frame.scan];
      for (const double side : {-1.0, 1.0}) {
        const Vec2 aside = kSideOfEdge_px * side * landmark.gradient.normalized();
        if (!measured.Holds(seen->px + aside)) continue;
        const double x = landmark.value + landmark.gradient.dot(aside);
        const double y = measured.At(0, seen->px + aside);
        n += 1;
        a += x;
        b += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
      }
    }
  }
  const double spread = std::sqrt((n * aa - a * a) * (n * bb - b * b));
  return spread > 0 ? (n * ab - a * b) / spread : 0;
}

double PictureRegistration::MeanLandmarks() const {
  double count = 0;
  for (const auto& of_frame : squares_) count += static_cast<double>(of_frame.size());
  return squares_.empty() ? 0 : count / static_cast<double>(squares_.size());
}

}  // namespace tera
