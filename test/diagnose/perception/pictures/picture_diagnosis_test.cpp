#include "diagnose/perception/pictures/picture_diagnosis.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "diagnose/perception/paint.h"
#include "diagnose/perception/true_sensor.h"

namespace tera {
namespace {

using ::testing::HasSubstr;
using testing::IdOf;
using testing::NumberOf;
/// A camera above a painted plane, z = 0, next to a painted wall, x = 9.
///
/// Frames  W; B the link, which turns back and forth and creeps; S; C optical.
struct PaintedYard {
  testing::TrueSensor is;
  double noise = 0.006;  ///< of a value from 0 to 1
  double gain = 1, offset = 0;
  double duration_s = 24;
  bool moves = true, painted = true;
  bool has_bonnet = false;  ///< a painted edge of the machine, a metre before the camera
  std::uint64_t seed = 4;
};

constexpr int kWidth = 160, kHeight = 120;
constexpr double kFocal_px = 140;

BodyState LinkAt(double t_s, bool moves) {
  BodyState link;
  if (!moves) t_s = 1;
  const double yaw_rad = 0.35 * std::sin(0.8 * t_s);
  link.X_WB = MakePose({0.05 * t_s, 0.3, 1.6}, 0.01, -0.02, yaw_rad);
  if (!moves) return link;
  link.v_WB_mps = {0.05, 0, 0};
  link.w_WB_radps = {0, 0, 0.35 * 0.8 * std::cos(0.8 * t_s)};
  return link;
}

/// Range to the bonnet, which moves with B; infinite without a hit.
double BonnetAt(const Vec3& from_B_m, const Vec3& d_B) {
  const double t = (1.5 - from_B_m.x()) / d_B.x();
  return d_B.x() > 0 && from_B_m.z() + t * d_B.z() < 0.15 ? t : 1e9;
}

SimulatedPicture PictureFrom(const Pose& X_WC, const Pose& X_BC, const PaintedYard& yard) {
  SimulatedPicture picture{Image<float>(kWidth, kHeight), Image<float>(kWidth, kHeight),
                           Image<std::uint8_t>(kWidth, kHeight)};
  const Vec3 from_m = X_WC.translation();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Vec3 d_W = X_WC.linear() * Vec3((x - 79.5) / kFocal_px, (y - 59.5) / kFocal_px, 1);
      const double to_wall = d_W.x() > 0 ? (9 - from_m.x()) / d_W.x() : 1e9;
      const double to_floor = d_W.z() < 0 ? -from_m.z() / d_W.z() : 1e9;
      const Vec3 d_C = X_WC.linear().transpose() * d_W, d_B = X_BC.linear() * d_C;
      const double to_bonnet = yard.has_bonnet ? BonnetAt(X_BC.translation(), d_B) : 1e9;
      const double z_m = std::min({to_wall, to_floor, to_bonnet});
      const Vec3 p_W_m = from_m + z_m * d_W;
      const bool wall = to_wall < to_floor;
      const bool bonnet = z_m == to_bonnet;
      const Vec3 p_B_m = X_BC.translation() + z_m * d_B;
      const double grey = bonnet ? PaintAt(5 * p_B_m.y(), 5 * p_B_m.z() + 70)
                          : wall ? PaintAt(p_W_m.y() + 40, p_W_m.z())
                                 : PaintAt(p_W_m.x(), p_W_m.y());
      picture.grey.at(x, y) = yard.painted ? static_cast<float>(grey) : 0.4f;
      picture.depth_m.at(x, y) = static_cast<float>(z_m);
      picture.surface.at(x, y) = static_cast<std::uint8_t>(bonnet ? Surface::kMachine
                                                           : wall ? Surface::kObstacle
                                                                  : Surface::kGround);
    }
  }
  return picture;
}

PictureSource PicturesOf(const PaintedYard& yard) {
  PictureSource source;
  source.channel = "excavator1/camera";
  source.target = "camera";
  source.X_BS = MakePose({0.4, -0.1, 0.9}, 0.02, 0.35, 0.1);
  Mat3 R_SC;
  R_SC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  source.X_SC.linear() = R_SC;
  const double first_s = 10;
  const auto picture_at = [=, X_SC = source.X_SC](double t_s, const Pose& X_BT,
                                                  const PaintedYard& of) {
    const Pose X_BC = X_BT * X_SC;
    return PictureFrom(LinkAt(t_s, of.moves).X_WB * X_BC, X_BC, of);
  };
  const Pose X_BT = yard.is.Calibration(source.X_BS).X_BT;
  const Stream noise(yard.seed, "test/grey");
  std::uint64_t draw = 0;
  for (double t_s = first_s; t_s < first_s + yard.duration_s; t_s += 0.8) {
    source.t_ns.push_back(FromSeconds(t_s + yard.is.clock_offset_s));
    Image<float> grey = picture_at(t_s, X_BT, yard).grey;
    for (float& value : grey.data) {
      const double seen = yard.gain * value + yard.offset + yard.noise * noise.Gaussian(draw++);
      value = static_cast<float>(std::clamp(seen, 0.0, 1.0));
    }
    source.grey.push_back(std::move(grey));
  }
  const std::vector<TimeNs> t_ns = source.t_ns;
  source.render = [=](std::size_t frame,
                      const SensorCalibration& calibration) -> std::optional<SimulatedPicture> {
    const double t_s = ToSeconds(t_ns[frame]) - calibration.clock_offset_s;
    PaintedYard painted = yard;
    painted.painted = true;
    return picture_at(t_s, calibration.X_BT, painted);
  };
  source.link_at = [=, moves = yard.moves](
                       std::size_t frame,
                       const SensorCalibration& calibration) -> std::optional<BodyState> {
    return LinkAt(ToSeconds(t_ns[frame]) - calibration.clock_offset_s, moves);
  };
  source.project = [](const Vec3& p_C_m) {
    return Vec2(79.5 + kFocal_px * p_C_m.x() / p_C_m.z(), 59.5 + kFocal_px * p_C_m.y() / p_C_m.z());
  };
  source.ray = [](const Vec2& px) -> std::optional<Vec3> {
    return Vec3((px.x() - 79.5) / kFocal_px, (px.y() - 59.5) / kFocal_px, 1);
  };
  return source;
}

PerceptionDiagnosis DiagnosisOf(const PaintedYard& yard) {
  return DiagnosePictures(PicturesOf(yard), 3);
}

TEST(PicturedSensor, ThatSitsAskewIsFoundWithItsAnglesAndPlace) {
  PaintedYard yard;
  yard.is.rpy_deg.x() = 0.8;
  yard.is.rpy_deg.y() = -1;
  yard.is.rpy_deg.z() = 1.5;
  yard.is.shift_B_m.x() = 0.05;
  yard.is.shift_B_m.z() = -0.04;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(yard);
  ASSERT_EQ(diagnosis.findings.size(), 1u) << diagnosis.not_judged;
  const PerceptionFinding& found = diagnosis.findings[0];
  EXPECT_EQ(IdOf(found), "extrinsic");
  EXPECT_NEAR(NumberOf(found, "roll_deg"), 0.8, 0.05);
  EXPECT_NEAR(NumberOf(found, "pitch_deg"), -1, 0.05);
  EXPECT_NEAR(NumberOf(found, "yaw_deg"), 1.5, 0.05);
  EXPECT_NEAR(NumberOf(found, "x_m"), 0.05, 0.01);
  EXPECT_NEAR(NumberOf(found, "y_m"), 0, 0.01);
  EXPECT_NEAR(NumberOf(found, "z_m"), -0.04, 0.01);
  EXPECT_LT(found.finding.held_out.rmse_after, 0.3 * found.finding.held_out.rmse_before);
}

TEST(PicturedSensor, ThatSitsElsewhereIsFoundBehindThePartsOfItsMachineNearBy) {
  PaintedYard yard;
  yard.has_bonnet = true;
  yard.is.rpy_deg.y() = -0.7;
  yard.is.rpy_deg.z() = 1;
  // 6 px of the bonnet, 1 px of the wall.
  yard.is.shift_B_m.z() = 0.05;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(yard);
  ASSERT_EQ(diagnosis.findings.size(), 1u) << diagnosis.not_judged;
  const PerceptionFinding& found = diagnosis.findings[0];
  EXPECT_EQ(IdOf(found), "extrinsic");
  EXPECT_NEAR(NumberOf(found, "pitch_deg"), -0.7, 0.05);
  EXPECT_NEAR(NumberOf(found, "yaw_deg"), 1, 0.05);
  EXPECT_NEAR(NumberOf(found, "z_m"), 0.05, 0.005);
}

TEST(PicturedSensor, WithAnotherClockIsFoundWhileItTurns) {
  PaintedYard yard;
  yard.is.clock_offset_s = 0.12;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(yard);
  ASSERT_EQ(diagnosis.findings.size(), 1u) << diagnosis.not_judged;
  EXPECT_EQ(IdOf(diagnosis.findings[0]), "clock_offset");
  EXPECT_NEAR(NumberOf(diagnosis.findings[0], "offset_s"), 0.12, 0.005);
}

TEST(PicturedSensor, AtRestTellsNothingOfItsClock) {
  PaintedYard yard;
  yard.moves = false;
  yard.is.clock_offset_s = 0.12;
  const PerceptionDiagnosis diagnosis = DiagnosisOf(yard);
  EXPECT_TRUE(diagnosis.findings.empty());
  for (const ParameterDetectability& one : diagnosis.detectability) {
    if (one.candidate->mechanism->id == "clock_offset") {
      EXPECT_FALSE(one.smallest);
    }
  }
}

TEST(PicturedSensor, AsDescribedGivesNoFindingWhateverItsExposure) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    PaintedYard yard;
    yard.seed = seed;
    yard.gain = 0.5 + 0.1 * static_cast<double>(seed);
    yard.offset = 0.05;
    const PerceptionDiagnosis diagnosis = DiagnosisOf(yard);
    EXPECT_TRUE(diagnosis.is_judged()) << diagnosis.not_judged;
    EXPECT_TRUE(diagnosis.findings.empty()) << seed;
    EXPECT_TRUE(diagnosis.unconfirmed.empty()) << seed;
    EXPECT_LT(diagnosis.noise_rmse, 0.5);
  }
}

TEST(PicturedSensor, InTheDarkIsNotJudged) {
  PaintedYard yard;
  yard.gain = 0.02;
  EXPECT_THAT(DiagnosisOf(yard).not_judged, HasSubstr("no contrast"));
}

TEST(PicturedSensor, OfPicturesTooSmallToBlurIsNotJudged) {
  for (const auto& [width_px, height_px] : {std::pair(31, 120), {160, 31}, {1, 1}, {400, 0}}) {
    PictureSource source = PicturesOf({});
    for (Image<float>& grey : source.grey) grey = Image<float>(width_px, height_px);
    EXPECT_THAT(DiagnosePictures(source, 3).not_judged,
                HasSubstr(fmt::format("{} x {} pixels; need 32", width_px, height_px)));
  }
}

TEST(PicturedSensor, ThatLooksAtSomethingElseIsNotJudged) {
  PaintedYard yard;
  yard.is.shift_B_m.y() = 17;
  EXPECT_THAT(DiagnosisOf(yard).not_judged, HasSubstr("not like the simulated ones"));
}

}  // namespace
}  // namespace tera
