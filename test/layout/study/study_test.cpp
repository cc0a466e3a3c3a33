#include "layout/study/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using testing::AllOf;

class Study : public testing::Test {
 protected:
  LayoutStudy Read(const std::string& yaml) {
    const auto file = scratch_.path() / "study.yaml";
    WriteWholeFile(file, yaml);
    return LoadStudy(file);
  }
  std::vector<InputFault> FaultsOf(const std::string& yaml) {
    return FaultsIn([&] { Read(yaml); });
  }
  const ScratchDirectory scratch_;
};

TEST_F(Study, HasNoLimitOfMaskingButItsOwn) {
  EXPECT_FALSE(Read("eye: {link: upper, xyz_m: [0.1, 0.4, 1.3]}").eye->most_masking_m);
  EXPECT_EQ(
      Read("eye: {link: upper, xyz_m: [0.1, 0.4, 1.3], most_masking_m: 0.7}").eye->most_masking_m,
      0.7);
  EXPECT_THAT(FaultsOf("eye: {link: upper, xyz_m: [0.1, 0.4, 1.3], most_masking_m: -1}"),
              HasFaultAt("most_masking_m"));
}

TEST_F(Study, SaysWhatEntropiesAreComputedWith) {
  const InformationStudy given =
      Read("information: {voxel_m: 0.25, camera: {a: 0.07, b: 0.1}}").information;
  EXPECT_EQ(given.voxel_m, 0.25);
  EXPECT_EQ(given.camera.a, 0.07);
  EXPECT_EQ(given.camera.b, 0.1);
  EXPECT_EQ(given.lidar.a, InformationStudy().lidar.a);
  EXPECT_EQ(Read("information: {lidar: {a: 0.1, b: 0.2}}").information.lidar.b, 0.2);
}

TEST_F(Study, RefusesEntropiesWithoutSense) {
  EXPECT_THAT(FaultsOf("information: {voxel_m: 0, lidar: {a: 0.1}, camera: {a: -1, b: 0}}"),
              AllOf(HasFaultAt("information.voxel_m"), HasFaultAt("information.lidar.b"),
                    HasFaultAt("information.camera.a")));
  EXPECT_THAT(FaultsOf("information: {voxels_m: 0.5}"), HasFaultAt("information.voxels_m"));
}

}  // namespace
}  // namespace tera
