#include "dataset/compare/scan_comparison.h"

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "core/faults.h"
#include "core/quantile.h"
#include "core/units.h"
#include "dataset/compare/binned_values.h"
#include "dataset/compare/cloud_distance.h"
#include "dataset/compare/compare.h"
#include "dataset/compare/comparison_report.h"
#include "dataset/compare/ray_pairs.h"
#include "dataset/format/png.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

namespace fs = std::filesystem;
using enum FaultKind;
using testing::Each;
using testing::Gt;
using testing::HasSubstr;

constexpr int kBeams = 16, kColumns = 180;  // of 2 deg

/// A spinning lidar of 16 beams from +14 to -16 deg; the range of each direction by `range_m`, none
/// where it is 0. The first column is at `phase_deg`.
LidarScan Spin(const std::function<double(const Vec3& direction)>& range_m, double phase_deg = 0) {
  LidarScan scan;
  for (int column = 0; column < kColumns; ++column) {
    for (int beam = 0; beam < kBeams; ++beam) {
      const double azimuth = (phase_deg + 2.0 * column) * kDeg, height = (14.0 - 2 * beam) * kDeg;
      const Vec3 direction(std::cos(height) * std::cos(azimuth),
                           std::cos(height) * std::sin(azimuth), std::sin(height));
      const double range = range_m(direction);
      if (range <= 0) continue;
      const Eigen::Vector3f p = (range * direction).cast<float>();
      LidarPoint point;
      point.x_m = p.x(), point.y_m = p.y(), point.z_m = p.z();
      point.intensity = static_cast<float>(1 + (column + beam) % 200) / 255;
      point.time_offset_ns = static_cast<std::uint32_t>(column) * 500'000;
      point.ring = static_cast<std::uint16_t>(beam);
      scan.points.push_back(point);
    }
  }
  return scan;
}

/// A leaning wall whose foot of the perpendicular is `distance_m` away, seen up to 30 m.
LidarScan Wall(double distance_m, double phase_deg = 0) {
  const Vec3 normal = MakePose(Vec3::Zero(), 0, 0.2, 0.7).rotation() * Vec3::UnitX();
  return Spin(
      [=](const Vec3& direction) {
        const double range_m = distance_m / normal.dot(direction);
        return range_m < 30 ? range_m : 0.0;
      },
      phase_deg);
}

LidarScan Sphere(double radius_m) {
  return Spin([=](const Vec3&) { return radius_m; });
}

double Azimuth_deg(const LidarPoint& p) {
  const double azimuth_deg =
      std::atan2(static_cast<double>(p.y_m), static_cast<double>(p.x_m)) / kDeg;
  return azimuth_deg < -0.5 ? azimuth_deg + 360 : azimuth_deg;
}

bool IsInSector(const LidarPoint& p) {
  return Azimuth_deg(p) > 29 && Azimuth_deg(p) < 59;  // the columns of 30, 32 .. 58 deg
}
constexpr std::size_t kSectorRays = std::size_t{15} * kBeams;

TEST(CloudDistance, ShiftOfAPlaneIsTheDistanceFromItsSurface) {
  const CloudDistances d = DistancesFrom(Wall(6).points, Wall(6.05).points);
  ASSERT_GT(d.to_surface_m.size(), 300u);
  for (const double distance_m : d.to_surface_m) EXPECT_NEAR(distance_m, 0.05, 1e-5);
  EXPECT_THAT(d.to_point_m, Each(Gt(0.05 - 1e-5)));
  EXPECT_EQ(d.to_point_m.size(), Wall(6.05).points.size());
}

// Half a deg between beams and columns; 2 cm of noise along the ray.
TEST(CloudDistance, DeviationOnAPlaneIsTheNoiseOfTheRange) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise_m(0, 0.02);
  const Vec3 normal = MakePose(Vec3::Zero(), 0, 0.2, 0.3).rotation() * Vec3::UnitX();
  LidarScan wall;
  for (int row = -40; row <= 40; ++row) {
    for (int column = -40; column <= 40; ++column) {
      const Vec3 ray = MakePose(Vec3::Zero(), 0, 0.5 * row * kDeg, 0.5 * column * kDeg).rotation() *
                       Vec3::UnitX();
      const Eigen::Vector3f p = ((8 / normal.dot(ray) + noise_m(random)) * ray).cast<float>();
      LidarPoint point;
      point.x_m = p.x(), point.y_m = p.y(), point.z_m = p.z();
      wall.points.push_back(point);
    }
  }
  const std::vector<PlaneDeviation> found = DeviationsOnPlanes(wall.points);
  ASSERT_GT(found.size(), 400u);
  double square_sum_m2 = 0;
  for (const PlaneDeviation& one : found) square_sum_m2 += one.deviation_m * one.deviation_m;
  // 5 standard errors of a deviation of 400 values are 18 %; the fit of three numbers takes 1 %.
  EXPECT_NEAR(std::sqrt(square_sum_m2 / double(found.size())), 0.02, 0.2 * 0.02);
}

TEST(CloudDistance, LineHasNoSurface) {
  LidarScan line;
  for (int k = 0; k < 100; ++k) {
    LidarPoint p;
    p.x_m = 5, p.y_m = 0.01F * static_cast<float>(k);
    line.points.push_back(p);
  }
  EXPECT_TRUE(DistancesFrom(line.points, line.points).to_surface_m.empty());
  EXPECT_TRUE(DistancesFrom({}, line.points).to_point_m.empty());
  EXPECT_TRUE(DistancesFrom(line.points, {}).to_point_m.empty());
}

TEST(RayPairs, SectorThatIsDroppedIsLostAndNothingElse) {
  const LidarScan a = Sphere(5);
  LidarScan b = Sphere(5.5);
  std::erase_if(b.points, IsInSector);
  const RayPairs pairs = PairRays(a, b);
  EXPECT_EQ(pairs.only_a.size(), kSectorRays);
  EXPECT_EQ(pairs.only_b.size(), 0u);
  EXPECT_EQ(pairs.both.size(), b.points.size());
  for (const std::size_t k : pairs.only_a) EXPECT_TRUE(IsInSector(a.points[k]));
}

TEST(RayPairs, PatternsOfAnotherPhaseArePaired) {
  const LidarScan a = Sphere(5), b = Spin([](const Vec3&) { return 5.0; }, 0.9);
  EXPECT_EQ(PairRays(a, b).both.size(), a.points.size());
}

// Beams of b leave 4 cm above the origin, which is 0.46 deg at 5 m.
TEST(RayPairs, NumberedBeamsArePairedEvenIfTheyLeaveBesideTheOrigin) {
  LidarScan a = Sphere(1), b = a;
  for (LidarPoint& p : b.points) p.z_m += 0.04F;  // 2.3 deg at 1 m: more than from beam to beam
  EXPECT_EQ(PairRays(a, b).both.size(), a.points.size());
  for (LidarPoint& p : b.points) p.ring = 0;  // a driver that does not number them
  EXPECT_LT(PairRays(a, b).both.size(), a.points.size());
}

TEST(RayPairs, SecondReturnIsNoRay) {
  const LidarScan a = Sphere(5);
  LidarScan b;
  for (const LidarPoint& p : a.points) {
    b.points.push_back(p);
    LidarPoint behind = p;
    behind.x_m *= 1.5F, behind.y_m *= 1.5F, behind.z_m *= 1.5F;
    b.points.push_back(behind);
  }
  const RayPairs pairs = PairRays(a, b);
  ASSERT_EQ(pairs.both.size(), a.points.size());
  EXPECT_TRUE(pairs.only_b.empty());
  for (const auto& [in_a, in_b] : pairs.both) EXPECT_EQ(in_b, 2 * in_a);
}

// As of a beam that leaves 4 cm above the origin: by time and ring, the direction differs by 2 deg.
TEST(RayPairs, SecondReturnIsKnownByTimeAndRingOrElseByDirection) {
  LidarScan scan;
  for (const LidarPoint& p : Sphere(1).points) {
    scan.points.push_back(p);
    scan.points.push_back(p);
    scan.points.back().z_m += 0.04F;
  }
  EXPECT_EQ(FirstReturns(scan).size(), scan.points.size() / 2);
  for (LidarPoint& p : scan.points) p.ring = 0;
  EXPECT_EQ(FirstReturns(scan).size(), scan.points.size());
}

TEST(RayPairs, EmptyScanLosesAll) {
  const LidarScan a = Sphere(5), none;
  EXPECT_EQ(PairRays(a, none).only_a.size(), a.points.size());
  EXPECT_EQ(PairRays(none, a).only_b.size(), a.points.size());
  EXPECT_TRUE(PairRays(none, none).both.empty());
}

TEST(BinnedValues, QuantilesAreThoseOfTheValues) {
  BinnedValues values(0, 10, 0.01);
  for (int k = 1; k <= 1000; ++k) values.Add(0.01 * k - 0.005);
  EXPECT_NEAR(values.Quantile(0.25), 2.5, 0.01);
  EXPECT_NEAR(values.Quantile(0.95), 9.5, 0.01);
  EXPECT_NEAR(values.mean(), 5, 1e-12);
  EXPECT_NEAR(values.rms(), std::sqrt(100.0 / 3), 1e-4);
  EXPECT_EQ(BinnedValues(0, 1, 0.1).Quantile(0.5), 0);
}

constexpr const char* kMount =
    "type: lidar\nname: roof\nparent_link: upper\nX_parent_sensor: {{xyz_m: [0, 0.3, {}], "
    "quaternion_wxyz: [1, 0, 0, 0]}}\nrate_hz: 10\n";

/// Writes scans 0.1 s apart, the first at `first_ns`.
void WriteScans(const fs::path& directory, const std::vector<LidarScan>& scans, TimeNs first_ns = 0,
                double mount_m = 2, int columns = 0) {
  DatasetWriter writer(directory, SampleInfo(), {});
  std::string sheet = fmt::format(kMount, mount_m);
  if (columns > 0) {
    std::vector<double> elevation_deg;
    for (int beam = 0; beam < kBeams; ++beam) elevation_deg.push_back(14 - 2 * beam);
    sheet += fmt::format("model: {{elevation_deg: [{}], columns: {}}}\n",
                         fmt::join(elevation_deg, ", "), columns);
  }
  const ChannelId lidar = writer.AddChannel(LidarChannel("husky/roof", sheet));
  TimeNs t_ns = first_ns;
  for (LidarScan scan : scans) {
    scan.t_ns = scan.t_available_ns = t_ns;
    t_ns += kSamplePeriod_ns;
    writer.Write(lidar, std::move(scan));
  }
  writer.Finish();
}

/// The comparison of the only lidar of two recordings.
ScanComparison ComparedScans(const fs::path& folder) {
  const Comparison c = Compare(folder / "real", folder / "sim");
  EXPECT_EQ(c.machines.at(0).scans.size(), 1u);
  return c.machines.at(0).scans.at(0);
}

TEST(ScanComparison, RangesDropOutAndReflectivityAreThoseOfTheGeometry) {
  ScratchDirectory scratch;
  LidarScan sim = Sphere(6);
  for (LidarPoint& p : sim.points) {
    p.intensity *= 0.8F;
    p.label =
        static_cast<std::uint8_t>(IsInSector(p) ? SemanticClass::kPerson : SemanticClass::kTerrain);
  }
  LidarScan real = Sphere(4);
  std::erase_if(real.points, IsInSector);
  WriteScans(scratch.path() / "real", {real, real});
  WriteScans(scratch.path() / "sim", {sim, sim});
  const ScanComparison c = ComparedScans(scratch.path());
  constexpr std::int64_t kAll = 2 * kBeams * kColumns, kLost = 2 * kSectorRays;
  EXPECT_EQ(c.a.points, kAll - kLost);
  EXPECT_EQ(c.b.points, kAll);
  EXPECT_EQ(c.a.range_share[2], 1);  // from 2 to 5 m
  EXPECT_EQ(c.b.range_share[3], 1);  // from 5 to 10 m
  EXPECT_NEAR(c.range_mean_m, 2, 1e-5);
  EXPECT_NEAR(c.range_median_m, 2, 1e-3);
  EXPECT_NEAR(c.range_rms_m, 2, 1e-5);
  EXPECT_NEAR(c.reflectivity_ratio, 0.8, 1e-3);
  std::vector<float> bright;
  for (const LidarPoint& p : Sphere(6).points) bright.push_back(p.intensity);
  EXPECT_NEAR(c.b.reflectivity[2], 0.8 * double(Median(bright)), 0.5 / 255);
  EXPECT_EQ(c.rays_both, kAll - kLost);
  EXPECT_EQ(c.rays_only_b, kLost);
  ASSERT_EQ(c.classes.size(), 2u);
  EXPECT_EQ(c.classes[0].name, "terrain");
  EXPECT_EQ(c.classes[0].rays, kAll - kLost);
  EXPECT_EQ(c.classes[0].lost, 0);
  EXPECT_EQ(c.classes[1].name, "person");
  EXPECT_EQ(c.classes[1].rays, kLost);
  EXPECT_EQ(c.classes[1].lost, kLost);
  EXPECT_TRUE(c.classes[1].is_of_b);
  // From the sphere of 4 m each point of that of 6 m is 2 m away, and the same back; in the sector
  // it is farther from one side.
  EXPECT_NEAR(c.a_to_b.mean_m, 2, 1e-5);
  EXPECT_GT(c.b_to_a.mean_m, 2);
  EXPECT_NEAR(c.chamfer_m, c.a_to_b.mean_m + c.b_to_a.mean_m, 1e-9);
}

TEST(ScanComparison, RaysWithoutAReturnAndSecondReturnsAreCounted) {
  ScratchDirectory scratch;
  LidarScan real = Sphere(5), sim;
  std::erase_if(real.points, IsInSector);
  for (const LidarPoint& p : real.points) {
    sim.points.push_back(p);
    if (p.ring != 3) continue;
    sim.points.push_back(p);
    sim.points.back().x_m *= 1.5F, sim.points.back().y_m *= 1.5F, sim.points.back().z_m *= 1.5F;
  }
  WriteScans(scratch.path() / "real", {real}, 0, 2, kColumns);
  WriteScans(scratch.path() / "sim", {sim});
  const ScanComparison c = ComparedScans(scratch.path());
  EXPECT_NEAR(c.a.without_return.value(), 15.0 / kColumns, 1e-12);
  EXPECT_FALSE(c.b.without_return);
  EXPECT_EQ(c.a.second_returns, 0);
  EXPECT_EQ(c.b.second_returns, kColumns - 15);
}

TEST(ScanComparison, WorstFramesComeFirstAndAreWrittenSideBySide) {
  ScratchDirectory scratch;
  const fs::path folder = scratch.path();
  WriteScans(folder / "real", {Wall(6), Wall(6), Wall(6), Wall(6), Wall(6), Wall(6)});
  WriteScans(folder / "sim", {Wall(6.01), Wall(6.02), Wall(6.3), Wall(6.03), Wall(6.1), Wall(6)},
             20'000'000);
  const Comparison c = Compare(folder / "real", folder / "sim");
  const ScanComparison& scans = c.machines.at(0).scans.at(0);
  ASSERT_EQ(scans.worst.size(), 4u);
  EXPECT_EQ(scans.worst[0].t.a_ns, 200'000'000);
  EXPECT_EQ(scans.worst[0].t.b_ns, 220'000'000);
  EXPECT_EQ(scans.worst[1].t.a_ns, 400'000'000);
  EXPECT_EQ(WriteWorstFrames(c, folder / "real", folder / "sim", folder / "worst"), 4);
  const auto picture = ReadRgbPng(folder / "worst" / "husky_roof_1_200000000.png");
  EXPECT_EQ(picture.width_px, 2 * picture.height_px * 4 / 3);
  EXPECT_THAT([&] { WriteWorstFrames(c, folder / "real", folder / "sim", folder / "worst"); },
              ThrowsFault(kInconsistent, "worst"));
  const auto json = nlohmann::json::parse(ComparisonJson(c));
  const auto& told = json["machines"][0]["scans"][0];
  EXPECT_EQ(told["lidar"], "roof");
  EXPECT_EQ(told["worst"][0]["t_ns"], 200'000'000);
  EXPECT_EQ(told["pairs"], 6);
  EXPECT_NEAR(told["reference_to_surface"]["mean_m"], (0.01 + 0.02 + 0.3 + 0.03 + 0.1) / 6, 0.02);
  EXPECT_THAT(ComparisonTable(c), HasSubstr("worst at 0.200 s"));
}

TEST(ScanComparison, FramesAreOfOneTimeAndMountsAreOneOrTold) {
  ScratchDirectory scratch;
  WriteScans(scratch.path() / "real", {Wall(6), Wall(6), Wall(6)});
  WriteScans(scratch.path() / "sim", {Wall(6), Wall(6)}, 140'000'000, 2.5);
  const ScanComparison c = ComparedScans(scratch.path());
  // 140 ms is nearest to 100 ms, 240 ms to 200 ms; nothing is within 50 ms of 0.
  ASSERT_EQ(c.sensor.pairs.size(), 2u);
  EXPECT_EQ(c.sensor.pairs[0].a_ns, 100'000'000);
  EXPECT_EQ(c.sensor.pairs[1].b_ns, 240'000'000);
  EXPECT_THAT(c.sensor.remark, HasSubstr("0.500 m"));
  EXPECT_EQ(Compare(scratch.path() / "real", scratch.path() / "sim", 2)
                .machines[0]
                .scans[0]
                .sensor.pairs.size(),
            1u);
}

}  // namespace
}  // namespace tera
