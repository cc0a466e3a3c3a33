#include "diagnose/perception/pictures/picture_registration.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kSquare = 1.0 / 30;  ///< of the width
constexpr double kLeastSlope = 0.08;  ///< of brightness over its spread, a pixel
constexpr double kBorder = 0.02;      ///< of the width, without landmarks
constexpr double kBrightness = 0.1, kPlace_px = 0.2;
constexpr double kShift_m[PictureLevels::kCount] = {0, 0.02, 0.05, 0.1};
constexpr double kTurn_rad = 1e-6, kMove_m = 1e-5;
constexpr double kBefore_m = 0.05;  ///< the camera

/// The nearest depth of a pixel and its neighbours; 0 where there is none.
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

/// What is seen there, nothing where some of it is not to be compared.
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

/// The pixel of a square where brightness changes most; nothing where it hardly does.
std::optional<Vec2> SteepestIn(const PictureLevels& levels, int level, int left, int top,
                               int size) {
  std::optional<Vec2> px;
  double steepest = kLeastSlope * std::pow(0.5, level);
  for (int y = top; y < top + size; ++y) {
    for (int x = left; x < left + size; ++x) {
      const double slope = levels.GradientAt(level, Vec2(x, y)).norm();
      if (slope <= steepest) continue;
      steepest = slope;
      px = Vec2(x, y);
    }
  }
  return px;
}

}  // namespace

PictureRegistration::PictureRegistration(const PictureSource& source, const SensorNumbers& numbers)
    : source_(source), squares_(source.t_ns.size()) {
  for (std::size_t f = 0; f < source.t_ns.size(); ++f) {
    measured_.emplace_back(source.grey[f]);
    const auto simulated = source.render(f, numbers);
    const auto link = source.link_at(f, numbers);
    if (simulated && link) AddLandmarks(f, *simulated, *link, numbers);
  }
}

std::optional<PictureRegistration::Landmark> PictureRegistration::LandmarkAt(
    const SimulatedPicture& simulated, const BodyState& link, const SensorNumbers& numbers,
    const Vec2& px) const {
  const int x = static_cast<int>(px.x()), y = static_cast<int>(px.y());
  const double depth_m = ForegroundDepth_m(simulated.depth_m, x, y);
  const auto surface = SurfaceAt(simulated, x, y);
  const auto ray = source_.ray(px);
  if (!(depth_m > 0) || !surface || !ray) return std::nullopt;
  Landmark landmark;
  landmark.surface = *surface;
  const Vec3 p_S_m = source_.X_SC * Vec3(depth_m * *ray);
  landmark.p_m = source_.X_BS.translation() + numbers.shift_B_m() +
                 source_.X_BS.linear() * (numbers.R_ST() * p_S_m);
  if (*surface != Surface::kMachine) landmark.p_m = link.X_WB * landmark.p_m;
  return landmark;
}

void PictureRegistration::AddLandmarks(std::size_t frame, const SimulatedPicture& simulated,
                                       const BodyState& link, const SensorNumbers& numbers) {
  const PictureLevels levels(simulated.grey);
  const int width = simulated.grey.width_px, height = simulated.grey.height_px;
  const int size = std::max(4, static_cast<int>(kSquare * width));
  const int border = std::max(2, static_cast<int>(kBorder * width));
  for (int top = border; top + size <= height - border; top += size) {
    for (int left = border; left + size <= width - border; left += size) {
      Square square;
      for (int k = 0; k < PictureLevels::kCount; ++k) {
        const auto px = SteepestIn(levels, k, left, top, size);
        if (!px) continue;
        auto& landmark = square[static_cast<std::size_t>(k)];
        landmark = LandmarkAt(simulated, link, numbers, *px);
        if (!landmark) continue;
        landmark->value = levels.At(k, *px);
        landmark->slope = levels.GradientAt(k, *px);
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

std::optional<PictureRegistration::Seen> PictureRegistration::SeenAt(
    const Landmark& landmark, const BodyState& link, const SensorNumbers& numbers) const {
  const bool moves_along = landmark.surface == Surface::kMachine;
  const Vec3 p_B_m = moves_along ? landmark.p_m : Vec3(link.X_WB.inverse() * landmark.p_m);
  const Mat3 R_SB = source_.X_BS.linear().transpose();
  const Mat3 R_TS = numbers.R_ST().transpose();
  const Vec3 p_S_m = R_SB * (p_B_m - source_.X_BS.translation() - numbers.shift_B_m());
  const Pose X_CT = source_.X_SC.inverse();
  const Vec3 p_C_m = X_CT * Vec3(R_TS * p_S_m);
  if (p_C_m.z() < kBefore_m) return std::nullopt;
  Seen seen;
  seen.px = source_.project(p_C_m);
  Eigen::Matrix<double, 2, 3> lens;
  for (int a = 0; a < 3; ++a) {
    lens.col(a) = (source_.project(p_C_m + kMove_m * Vec3::Unit(a)) - seen.px) / kMove_m;
  }
  const Eigen::Matrix<double, 2, 3> by_T = lens * X_CT.linear();
  const Eigen::Matrix<double, 2, 3> by_B = by_T * R_TS * R_SB;
  seen.slope.leftCols<3>() = -by_B;
  for (int a = 0; a < 3; ++a) {
    SensorNumbers turned = numbers;
    turned.value[static_cast<std::size_t>(SensorNumbers::kRoll + a)] += kTurn_rad;
    seen.slope.col(SensorNumbers::kRoll + a) =
        by_T * ((turned.R_ST().transpose() - R_TS) * p_S_m) / kTurn_rad;
  }
  if (!moves_along) {
    // Later by the clock is earlier in truth.
    const Vec3 v_W_mps =
        link.v_WB_mps + link.w_WB_radps.cross(landmark.p_m - link.X_WB.translation());
    seen.slope.col(SensorNumbers::kOffset) = by_B * (link.X_WB.linear().transpose() * v_W_mps);
  }
  return seen;
}

std::vector<PointResidual> PictureRegistration::Compare(const std::vector<ScanPoints>& points,
                                                        const SensorNumbers& numbers,
                                                        int level) const {
  const auto k = static_cast<std::size_t>(level);
  std::vector<PointResidual> residuals;
  for (const ScanPoints& of_frame : points) {
    const auto link = source_.link_at(of_frame.scan, numbers);
    for (const std::size_t p : of_frame.points) {
      const std::optional<Landmark>& landmark = squares_[of_frame.scan][p][k];
      PointResidual residual;
      residual.scan = of_frame.scan;
      const auto seen = link && landmark ? SeenAt(*landmark, *link, numbers) : std::nullopt;
      const PictureLevels& measured = measured_[of_frame.scan];
      residual.out_of_picture = seen && !measured.Holds(seen->px);
      if (seen && !residual.out_of_picture) {
        const double steep = std::max(1e-3, landmark->slope.norm());
        const Vec2 slope = 0.5 * (landmark->slope + measured.GradientAt(level, seen->px));
        residual.surface = landmark->surface;
        residual.beyond = (measured.At(level, seen->px) - landmark->value) / steep;
        const double parallax_pxpm = seen->slope.leftCols<3>().norm() / std::sqrt(2.0);
        residual.sigma =
            std::hypot(kBrightness / steep, kPlace_px, kShift_m[level] * parallax_pxpm);
        residual.slope = (slope.transpose() * seen->slope).transpose() / steep;
      }
      residuals.push_back(residual);
    }
  }
  return residuals;
}

double PictureRegistration::Likeness(const std::vector<ScanPoints>& points,
                                     const SensorNumbers& numbers) const {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (const ScanPoints& of_frame : points) {
    const auto link = source_.link_at(of_frame.scan, numbers);
    if (!link) continue;
    for (const std::size_t p : of_frame.points) {
      const Landmark& landmark = *squares_[of_frame.scan][p][0];
      const auto seen = SeenAt(landmark, *link, numbers);
      if (!seen) continue;
      const PictureLevels& measured = measured_[of_frame.scan];
      // Both sides of the edge: the middle alone is grey in every picture.
      for (const double side : {-1.0, 1.0}) {
        const Vec2 aside = 1.5 * side * landmark.slope.normalized();
        if (!measured.Holds(seen->px + aside)) continue;
        const double x = landmark.value + landmark.slope.dot(aside);
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

double PictureRegistration::LandmarksOfFrame() const {
  double count = 0;
  for (const auto& of_frame : squares_) count += static_cast<double>(of_frame.size());
  return squares_.empty() ? 0 : count / static_cast<double>(squares_.size());
}

}  // namespace tera
