#include "view/stage_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

namespace tera {
namespace {

TEST(StageFile, HoldsAHeaderAndTheArraysThatItPointsTo) {
  Stage stage;
  stage.bodies = 3;
  stage.meshes.push_back({{{.positions_m = {0, 0, 0, 1, 0, 0, 0, 2, 0},
                            .normals = {0, 0, 1, 0, 0, 1, 0, 0, 1},
                            .indices = {0, 1, 2}}}});
  const Mat3 quarter_turn = Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitZ()).toRotationMatrix();
  stage.nodes.push_back({.mesh = 0, .body = 2, .X_BG = MakePose(Vec3(1, 2, 3), quarter_turn)});
  const std::string file = StageFile(stage);

  ASSERT_EQ(file.substr(0, 4), "TSTG");
  std::uint32_t length = 0;
  std::memcpy(&length, &file[4], sizeof length);
  const auto header = nlohmann::json::parse(file.substr(8, length));
  EXPECT_EQ(header["bodies"], 3);
  EXPECT_EQ(header["nodes"][0]["body"], 2);
  const std::vector<double> pose = header["nodes"][0]["X_BG"];  // w and z of a quarter turn alike
  EXPECT_EQ(pose[1], 2.0);
  EXPECT_NEAR(pose[3], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(pose[6], std::sqrt(0.5), 1e-12);

  const auto& part = header["meshes"][0]["parts"][0];
  EXPECT_FALSE(part.contains("colours"));
  ASSERT_EQ(part["positions"][1], 9);
  float y = 0;
  std::memcpy(&y, &file[8 + length + part["positions"][0].get<std::size_t>() + 7 * 4], sizeof y);
  EXPECT_EQ(y, 2.0f);
  std::uint32_t last = 0;
  std::memcpy(&last, &file[8 + length + part["indices"][0].get<std::size_t>() + 2 * 4],
              sizeof last);
  EXPECT_EQ(last, 2u);
  EXPECT_EQ((8 + length) % 8, 0u);  // arrays of 32-bit numbers are read in place
}

}  // namespace
}  // namespace tera
