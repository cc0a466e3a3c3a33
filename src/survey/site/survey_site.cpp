#include "survey/site/survey_site.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "survey/points/outliers.h"
#include "survey/points/read_survey.h"
#include "survey/site/cell_size.h"
#include "survey/site/ground_filter.h"

namespace tera {
namespace {

constexpr double kLargestSite_m = 2000;  ///< limit of a scenario

/// An origin near the points, for sufficient precision of floats. It is a multiple of 100 m. For a
/// raster it is the corner of a pixel, so that cells coincide with pixels.
Vec3 BaseOf(const Survey& survey) {
  constexpr double kStep_m = 100;
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : survey.p_m) sum += p;
  const auto count = static_cast<double>(survey.p_m.size());
  Vec3 base_m = kStep_m * (sum / (kStep_m * count)).array().round().matrix();
  if (survey.pixel_m) base_m.head<2>() = survey.p_m.front().head<2>() - 0.5 * *survey.pixel_m;
  return base_m;
}

/// Throws InputError for a survey that is too large or too small for a site. Returns the centre of
/// its x and y.
Vec2 RequireSite(const std::filesystem::path& file, const std::vector<Vec3>& p_m) {
  Vec3 low_m = p_m.front(), high_m = low_m;
  for (const Vec3& p : p_m) {
    low_m = low_m.cwiseMin(p);
    high_m = high_m.cwiseMax(p);
  }
  const Vec3 size_m = high_m - low_m;
  if (std::max(size_m.x(), size_m.y()) > kLargestSite_m) {
    throw InputError(
        file.string(),
        {FaultKind::kOutOfRange,
         fmt::format("{:.0f} x {:.0f} m found, a site has at most {} m a side; cut it out, e.g. "
                     "with pdal or gdalwarp -te, or convert millimetres to metres",
                     size_m.x(), size_m.y(), kLargestSite_m)});
  }
  constexpr double kSmallestSite_m = 1;
  if (std::min(size_m.x(), size_m.y()) < kSmallestSite_m) {
    throw InputError(file.string(), {FaultKind::kOutOfRange,
                                     fmt::format("{:.2f} x {:.2f} m found, a site has at least {} "
                                                 "m to a side; need x and y in metres, z up",
                                                 size_m.x(), size_m.y(), kSmallestSite_m)});
  }
  return 0.5 * (low_m + high_m).head<2>();
}

/// Throws InputError for a survey without a reference system that is far from its origin.
void RequireAboutOrigin(const std::filesystem::path& file, const Vec2& middle_m) {
  if (middle_m.norm() <= kLargestSite_m) return;
  throw InputError(
      file.string(),
      {FaultKind::kMissing,
       fmt::format(
           "names no map, and its middle x {:.0f}, y {:.0f} m lies {:.1f} km from the origin: are "
           "these map coordinates? name the map with --map EPSG:n, or centre them with --local",
           middle_m.x(), middle_m.y(), middle_m.norm() / 1000)});
}

/// Throws InputError for a flat survey that is upright, for example with y up.
///
/// Model   A survey is flat if its spread along one direction is less than a quarter of the spread
///         along any other. This direction must be within 60 deg of z, because work sites are less
///         steep.
void RequireUpright(const std::filesystem::path& file, const std::vector<Vec3>& p_m) {
  constexpr double kFlat = 0.25, kSteepest_rad = 60 * kDeg;
  Vec3 sum_m = Vec3::Zero();
  Mat3 squares_m2 = Mat3::Zero();
  for (const Vec3& p : p_m) sum_m += p, squares_m2 += p * p.transpose();
  const auto count = static_cast<double>(p_m.size());
  const Vec3 middle_m = sum_m / count;
  const Eigen::SelfAdjointEigenSolver<Mat3> spread(squares_m2 / count -
                                                   middle_m * middle_m.transpose());
  const Vec3 least = spread.eigenvectors().col(0);
  const bool is_flat = spread.eigenvalues()[0] < kFlat * kFlat * spread.eigenvalues()[1];
  if (!is_flat || std::abs(least.z()) > std::cos(kSteepest_rad)) return;
  throw InputError(
      file.string(),
      {FaultKind::kInconsistent,
       fmt::format("its points spread least along ({:.2f}, {:.2f}, {:.2f}), so this seems to be up "
                   "instead of z: does its y point up? turn y up to z with pdal translate -f "
                   "transformation and the matrix 1 0 0 0 0 0 -1 0 0 1 0 0 0 0 0 1",
                   least.x(), least.y(), least.z())});
}

std::vector<Vec3> WithoutOutliers(const std::vector<Vec3>& p_m, const OutlierRule& rule) {
  const std::vector<bool> is_outlier = FindOutliers(p_m, rule);
  std::vector<Vec3> kept_m;
  for (std::size_t k = 0; k < p_m.size(); ++k) {
    if (!is_outlier[k]) kept_m.push_back(p_m[k]);
  }
  return kept_m;
}

/// Moves a site back to the coordinates of the survey.
void Move(const Vec3& by_m, SurveySite* site) {
  site->terrain.grid.low_m += by_m.head<2>();
  for (float& z : site->terrain.height_m) z = static_cast<float>(z + by_m.z());
  for (SurveyThing& thing : site->things) {
    thing.footprint.middle_m += by_m.head<2>();
    thing.foot_m += by_m.z();
    thing.top_m += by_m.z();
    thing.ground_m += by_m.z();
  }
}

}  // namespace

SurveySite MakeSurveySite(const std::filesystem::path& file, const SiteRequest& request) {
  SurveyReading how;
  how.map = request.map;
  how.is_local = request.about_middle;
  how.coarsest_step_m = std::max(how.coarsest_step_m, request.cell_m.value_or(0));
  Survey survey = ReadSurvey(file, how);
  SurveySite site;
  site.warnings = survey.warnings;
  site.has_map = survey.map.has_value();
  site.map = survey.map ? *survey.map : LocalMapReference(request.origin);
  site.points = static_cast<std::int64_t>(survey.p_m.size());
  site.left_out = survey.left_out;
  const Vec3 base_m = BaseOf(survey);
  for (Vec3& p : survey.p_m) p -= base_m;

  const std::vector<Vec3> p_m = WithoutOutliers(survey.p_m, OutlierRule());
  site.outliers = site.points - static_cast<std::int64_t>(p_m.size());
  RequireUpright(file, p_m);
  const Vec2 middle_m = base_m.head<2>() + RequireSite(file, p_m);
  if (!site.has_map && request.about_middle) site.middle_m = middle_m;
  if (!site.has_map && !request.about_middle) RequireAboutOrigin(file, middle_m);
  const auto wanted_m = request.cell_m   ? request.cell_m
                        : survey.pixel_m ? std::optional(survey.pixel_m->maxCoeff())
                                         : std::nullopt;
  const double cell_m = CellSize(file, p_m, wanted_m);

  // Limits the windows of the filter to about twenty squares.
  constexpr double kSquares = 20;
  const GroundRule rule = {.square_m = std::max(cell_m, request.largest_thing_m / kSquares),
                           .largest_thing_m = request.largest_thing_m,
                           .steepest_rad = request.steepest_rad};
  const std::vector<float> above_m = HeightsAboveGround(p_m, rule);
  site.ground_points =
      std::count_if(above_m.begin(), above_m.end(), [](float above) { return above <= 0; });
  site.terrain = MakeTerrain(p_m, above_m, cell_m);
  if (site.terrain.CountOf(HeightSource::kMeasured) == 0) {
    throw InputError(
        file.string(),
        {FaultKind::kMissing,
         fmt::format("no ground found among {} points; need z up, in metres", p_m.size())});
  }
  site.things =
      FindThings(p_m, above_m, site.terrain,
                 {.gap_m = std::max(request.gap_m, 3 * cell_m), .voxel_m = std::min(cell_m, 0.1)});
  Vec3 from_origin_m = base_m;
  from_origin_m.head<2>() -= site.middle_m;
  if (!site.has_map) from_origin_m.z() += request.origin.height_m;
  Move(from_origin_m, &site);
  return site;
}

}  // namespace tera
