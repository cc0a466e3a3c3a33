#include "sensors/camera/surface_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "core/types/image_flow.h"
#include "core/units.h"
#include "render/gl/rasterizer.h"
#include "render/hand_made_scene.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

using testing::OneBodyEach;
using testing::WallMesh;

constexpr int kSurfaceLabelsWidth = 160, kSurfaceLabelsHeight = 120;
constexpr double kSurfaceLabelsFocal_px = 150;
constexpr double kRounding_px = 0.5 / 64 + 1e-3;  // of the pixel form, and of depth in 32 bits

LabelSet Labels(std::initializer_list<std::size_t> channels) {
  LabelSet labels;
  for (const std::size_t channel : channels) labels.set(channel);
  return labels;
}

/// A camera that looks along +y of W at a wall 6 m ahead of its initial place, and a square of 1 m,
/// 3 m ahead.
class FlowBeforeAWall : public ::testing::Test {
 protected:
  FlowBeforeAWall()
      : model_(OneBodyEach({WallMesh(20, 0.5), WallMesh(0.5, 0.5)})), rasterizer_(model_, {}) {
    lens_ = {.width_px = kSurfaceLabelsWidth,
             .height_px = kSurfaceLabelsHeight,
             .fx_px = kSurfaceLabelsFocal_px,
             .fy_px = kSurfaceLabelsFocal_px,
             .cx_px = 79.5,
             .cy_px = 59.5};
    square_W_m_ = {0, 3, 40};
    X_WS_ = MakePose({0, 0, 40}, 0, 0, 90 * kDeg);
  }

  CameraFrame Next(SurfaceLabels* labels) {
    SeenScene scene{X_WS_ * OpticalInSensor(), {}};
    scene.state.X_WB = {MakePose({0, 6, 40}, 0, 0, 90 * kDeg),
                        MakePose(square_W_m_, 0, 0, 90 * kDeg)};
    Image<std::uint16_t> body;
    CameraFrame frame =
        rasterizer_.Render(lens_, scene.X_WC, scene.state, UsualLabels(), nullptr, &body);
    labels->Fill(scene, frame.depth_m, body, &frame);
    return frame;
  }

  SceneModel model_;
  Rasterizer rasterizer_;
  CameraIntrinsics lens_;
  Vec3 square_W_m_;
  Pose X_WS_;
};

/// The shift in a pixel of scene flow: whole millimetres from the middle of its range; 0 0 0: none.
std::optional<Vec3> ShiftAt(const Image<std::uint16_t>& scene_flow, int x_px, int y_px) {
  const auto value = [&](int c) { return scene_flow.at(x_px, y_px, c); };
  if (value(0) == 0 && value(1) == 0 && value(2) == 0) return std::nullopt;
  return Vec3(value(0) - 32768, value(1) - 32768, value(2) - 32768) / 1000;
}

const LabelSet kFlows =
    Labels({kFlowToPreviousChannel, kFlowToThisChannel, kSceneFlowToPreviousChannel});

TEST_F(FlowBeforeAWall, FirstPictureHasNone) {
  SurfaceLabels labels(lens_, kFlows);
  const CameraFrame frame = Next(&labels);
  ASSERT_EQ(frame.flow_to_previous.data.size(), 3u * kSurfaceLabelsWidth * kSurfaceLabelsHeight);
  EXPECT_EQ(std::ranges::count(frame.flow_to_previous.data, 0),
            3 * kSurfaceLabelsWidth * kSurfaceLabelsHeight);
  EXPECT_EQ(std::ranges::count(frame.flow_to_this.data, 0),
            3 * kSurfaceLabelsWidth * kSurfaceLabelsHeight);
  EXPECT_EQ(std::ranges::count(frame.scene_flow_to_previous.data, 0),
            3 * kSurfaceLabelsWidth * kSurfaceLabelsHeight);
}

TEST_F(FlowBeforeAWall, SquareThatMovesHasItsOwn) {
  SurfaceLabels labels(lens_, kFlows);
  Next(&labels);
  square_W_m_.x() += 0.12;  // to the camera's right: 150 * 0.12 / 3 = 6 px
  const CameraFrame frame = Next(&labels);
  int on_square = 0, hidden = 0, seen = 0;
  for (int y = 0; y < kSurfaceLabelsHeight; ++y) {
    for (int x = 0; x < kSurfaceLabelsWidth; ++x) {
      const PixelFlow back = FlowAt(frame.flow_to_previous, x, y);
      const auto shift = ShiftAt(frame.scene_flow_to_previous, x, y);
      ASSERT_TRUE(shift) << x << " " << y;
      if (frame.instance.at(x, y) == 2) {
        ++on_square;
        EXPECT_EQ(back.state, FlowState::kSeen) << x << " " << y;
        EXPECT_NEAR(back.flow_px.x(), -6, kRounding_px);
        EXPECT_NEAR(back.flow_px.y(), 0, kRounding_px);
        EXPECT_LT((*shift - Vec3(-0.12, 0, 0)).norm(), 1e-3);
        continue;
      }
      EXPECT_NEAR(back.flow_px.norm(), 0, kRounding_px);
      EXPECT_LT(shift->norm(), 1e-6);
      (back.state == FlowState::kHidden ? hidden : seen) += 1;
      // The square covered columns 54.5 to 104.5, and covers 60.5 to 110.5.
      if (back.state == FlowState::kHidden) {
        EXPECT_TRUE(x >= 54 && x <= 60) << x;
      }
    }
  }
  // 50 x 50 px; a strip of 6 px at its left was behind it.
  EXPECT_EQ(on_square, 50 * 50);
  EXPECT_NEAR(hidden, 6 * 50, 50);
  EXPECT_EQ(seen + hidden, kSurfaceLabelsWidth * kSurfaceLabelsHeight - on_square);
}

TEST_F(FlowBeforeAWall, ForwardFlowLiesOnThePreviousPicture) {
  SurfaceLabels labels(lens_, kFlows);
  const CameraFrame before = Next(&labels);
  square_W_m_ += Vec3(0.12, 0, -0.06);  // right 6 px, down 3 px
  const CameraFrame frame = Next(&labels);
  int hidden = 0;
  for (int y = 0; y < kSurfaceLabelsHeight; ++y) {
    for (int x = 0; x < kSurfaceLabelsWidth; ++x) {
      const PixelFlow on = FlowAt(frame.flow_to_this, x, y);
      const bool is_square = before.instance.at(x, y) == 2;
      EXPECT_LT((on.flow_px - (is_square ? Vec2(6, 3) : Vec2(0, 0))).norm(), 2 * kRounding_px);
      if (on.state == FlowState::kHidden) {
        ++hidden;
        EXPECT_EQ(frame.instance.at(x, y), 2) << "behind where the square has come to";
      }
    }
  }
  EXPECT_NEAR(hidden, 50 * 50 - 44 * 47, 100);
}

TEST_F(FlowBeforeAWall, TurningCameraMovesTheSkyByItsTurnAlone) {
  SurfaceLabels labels(lens_, kFlows);
  X_WS_ = MakePose({0, 0, 40}, 0, 0, 270 * kDeg);  // away from the wall
  Next(&labels);
  X_WS_ = MakePose({0.4, -0.3, 40.2}, 0, 0, 272 * kDeg);  // to its left: all moves to the right
  const CameraFrame frame = Next(&labels);
  for (int x = 0; x < kSurfaceLabelsWidth; x += 7) {
    const double angle = std::atan((x - 79.5) / kSurfaceLabelsFocal_px);
    const double was_px = 79.5 + kSurfaceLabelsFocal_px * std::tan(angle - 2 * kDeg);
    const PixelFlow back = FlowAt(frame.flow_to_previous, x, 59);
    EXPECT_NEAR(back.flow_px.x(), was_px - x, kRounding_px) << x;
    EXPECT_EQ(back.state, was_px < -0.5 ? FlowState::kOutside : FlowState::kSeen) << x;
    EXPECT_FALSE(ShiftAt(frame.scene_flow_to_previous, x, 59)) << "infinitely far";
  }
}

TEST_F(FlowBeforeAWall, IsWhatOpenCvProjectsThroughALens) {
  lens_.k1 = -0.25;
  lens_.k2 = 0.07;
  lens_.p1 = 0.001;
  lens_.p2 = -0.0007;
  const cv::Matx33d K(kSurfaceLabelsFocal_px, 0, 79.5, 0, kSurfaceLabelsFocal_px, 59.5, 0, 0, 1);
  const std::vector<double> d = {lens_.k1, lens_.k2, lens_.p1, lens_.p2};
  SurfaceLabels labels(lens_, kFlows);
  Next(&labels);
  const Pose X_WC_before = X_WS_ * OpticalInSensor();
  X_WS_ = MakePose({0.2, 0.3, 39.9}, 0.01, -0.02, 91.5 * kDeg);
  const Pose X_WC = X_WS_ * OpticalInSensor();
  const CameraFrame frame = Next(&labels);
  for (int y = 4; y < kSurfaceLabelsHeight; y += 9) {
    for (int x = 3; x < kSurfaceLabelsWidth; x += 11) {
      std::vector<cv::Point2d> undistorted;
      cv::undistortPoints(
          std::vector<cv::Point2d>{{double(x), double(y)}}, undistorted, K, d, cv::noArray(),
          cv::noArray(),
          cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-9));
      const Vec3 ray_W = X_WC.linear() * Vec3(undistorted[0].x, undistorted[0].y, 1);
      const bool is_square = frame.instance.at(x, y) == 2;
      const double t = ((is_square ? 3.0 : 6.0) - X_WC.translation().y()) / ray_W.y();
      const Vec3 p_W = X_WC.translation() + t * ray_W;
      const Vec3 p_before = X_WC_before.inverse() * p_W;
      std::vector<cv::Point2d> at;
      cv::projectPoints(std::vector<cv::Point3d>{{p_before.x(), p_before.y(), p_before.z()}},
                        cv::Vec3d(), cv::Vec3d(), K, d, at);
      const PixelFlow back = FlowAt(frame.flow_to_previous, x, y);
      EXPECT_NEAR(back.flow_px.x(), at[0].x - x, 0.02) << x << " " << y;
      EXPECT_NEAR(back.flow_px.y(), at[0].y - y, 0.02) << x << " " << y;
    }
  }
}

TEST_F(FlowBeforeAWall, DistanceIsAlongTheRay) {
  SurfaceLabels labels(lens_, Labels({kDistanceChannel}));
  const CameraFrame frame = Next(&labels);
  EXPECT_TRUE(frame.flow_to_previous.empty());
  for (int x = 1; x < 50; x += 8) {
    const double along_m = 6 * std::hypot(1.0, (x - 79.5) / kSurfaceLabelsFocal_px,
                                          (8 - 59.5) / kSurfaceLabelsFocal_px);
    EXPECT_NEAR(frame.distance.at(x, 8), 1000 * along_m, 1.01) << x;
  }
}

/// A camera 3 m above ground, looking straight down.
class LabelsOfGround : public ::testing::Test {
 protected:
  LabelsOfGround()
      : model_(OneBodyEach({WallMesh(0.1, 0.5)})),
        ground_(testing::Ground(41, 41, 0.1, -2, [](double x, double) { return 0.1 * x; })),
        rasterizer_(model_, {}) {
    lens_ = {.width_px = 81, .height_px = 61, .fx_px = 60, .fy_px = 60, .cx_px = 40, .cy_px = 30};
  }

  CameraFrame At(TimeNs t_ns, SurfaceLabels* labels) {
    Mat3 R_WC;  // x right along +x, y down along -y, z down
    R_WC << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    SeenScene scene{MakePose({0, 0, 3}, R_WC), {}};
    scene.state.t_ns = t_ns;
    scene.state.X_WB = {MakePose({0, 0, -50})};
    scene.state.terrain = &ground_;
    Image<std::uint16_t> body;
    CameraFrame frame =
        rasterizer_.Render(lens_, scene.X_WC, scene.state, UsualLabels(), nullptr, &body);
    labels->Fill(scene, frame.depth_m, body, &frame);
    return frame;
  }

  SceneModel model_;
  TerrainSurface ground_;
  Rasterizer rasterizer_;
  CameraIntrinsics lens_;
};

TEST_F(LabelsOfGround, CutIsBelowTheFirstPicturesSurface) {
  SurfaceLabels labels(lens_, Labels({kGroundSoilChannel, kGroundStateChannel, kGroundChangeChannel,
                                      kGroundAgeChannel}));
  const CameraFrame first = At(0, &labels);
  EXPECT_EQ(first.ground_change.at(40, 30), 32768);
  EXPECT_EQ(first.ground_age.at(40, 30), 65535);
  EXPECT_EQ(first.ground_soil.at(40, 30), 1);
  // A square of 0.6 m is lowered by 0.25 m, made loose and wet.
  for (int j = 17; j <= 23; ++j) {
    for (int i = 17; i <= 23; ++i) {
      const float height_m = ground_.height_m(i, j) - 0.25f;
      ground_.Set(i, j, {height_m, {.soil = 2, .moisture = 51, .looseness = 200, .rut = 7}});
    }
  }
  const CameraFrame cut = At(2'000'000'000, &labels);
  EXPECT_NEAR(cut.ground_change.at(40, 30), 32768 - 250, 1);
  EXPECT_EQ(cut.ground_soil.at(40, 30), 3);
  EXPECT_EQ(cut.ground_state.at(40, 30, 0), 200);
  EXPECT_EQ(cut.ground_state.at(40, 30, 1), 51);
  EXPECT_EQ(cut.ground_state.at(40, 30, 2), 7);
  EXPECT_EQ(cut.ground_age.at(40, 30), 1);
  // A metre away, nothing changes.
  EXPECT_EQ(cut.ground_change.at(60, 30), 32768);
  EXPECT_EQ(cut.ground_age.at(60, 30), 65535);
  const CameraFrame later = At(4'500'000'000, &labels);
  EXPECT_EQ(later.ground_age.at(40, 30), 26) << "2.5 s";
  EXPECT_NEAR(later.ground_change.at(40, 30), 32768 - 250, 1);
}

TEST_F(LabelsOfGround, ThereIsNoneBeyondTheSite) {
  SurfaceLabels labels(lens_, Labels({kGroundSoilChannel, kGroundChangeChannel}));
  ground_ = testing::Ground(21, 21, 0.1, -1, [](double, double) { return 0.0; });
  const CameraFrame frame = At(0, &labels);
  // 60 px over 3 m: a metre is 20 px.
  EXPECT_EQ(frame.ground_soil.at(40 + 18, 30), 1);
  EXPECT_EQ(frame.ground_soil.at(40 + 22, 30), 0);
  EXPECT_EQ(frame.ground_change.at(40 + 22, 30), 0);
}

// A ball of 0.2 m seen from 2 m at 60 px is 6 px in radius; a clod's corners lie up to 0.22 of that
// nearer or farther.
TEST_F(LabelsOfGround, SoilInFlightIsWhereTheClodIs) {
  SurfaceLabels labels(lens_, Labels({kSoilInFlightChannel}));
  ground_.SetGrains({{.p_W_m = {0, 0, 1}, .radius_m = 0.2f}});
  const CameraFrame frame = At(0, &labels);
  int seen = 0;
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 81; ++x) {
      const std::uint8_t value = frame.soil_in_flight.at(x, y);
      const double away_px = std::hypot(x - 40, y - 30);
      ASSERT_TRUE(value == 0 || value == 255);
      if (value == 0) continue;
      ++seen;
      EXPECT_LT(away_px, 1.22 * 6.03 + 0.5) << x << " " << y;
    }
  }
  EXPECT_GT(seen, 0.6 * kPi * 36);
  EXPECT_EQ(frame.soil_in_flight.at(40, 30), 255);
  ground_.SetGrains({});
  const CameraFrame landed = At(100'000'000, &labels);
  EXPECT_EQ(std::ranges::count(landed.soil_in_flight.data, 0), 81 * 61);
}

TEST_F(LabelsOfGround, ClodInTheAirHasNoFlow) {
  SurfaceLabels labels(lens_, kFlows);
  ground_.SetGrains({{.p_W_m = {0, 0, 1}, .radius_m = 0.2f}});
  At(0, &labels);
  ground_.SetGrains({{.p_W_m = {0, 0, 0.8f}, .radius_m = 0.2f}});
  const CameraFrame frame = At(100'000'000, &labels);
  EXPECT_EQ(FlowAt(frame.flow_to_previous, 40, 30).state, FlowState::kUnknown);
  EXPECT_EQ(FlowAt(frame.flow_to_previous, 5, 5).state, FlowState::kSeen);
}

}  // namespace
}  // namespace tera
