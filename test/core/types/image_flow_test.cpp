#include "core/types/image_flow.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

Image<std::uint16_t> PictureOf(const std::array<std::uint16_t, 3>& pixel) {
  Image<std::uint16_t> picture(1, 1, 3);
  std::copy(pixel.begin(), pixel.end(), picture.data.begin());
  return picture;
}

TEST(ImageFlow, HasThePixelFormOfKitti) {
  // Worked by hand from the development kit's readme: (u - 2^15) / 64, valid.
  EXPECT_EQ(PixelOfFlow({0, 0}, FlowState::kSeen), (std::array<std::uint16_t, 3>{32768, 32768, 1}));
  EXPECT_EQ(PixelOfFlow({2.5, -3.25}, FlowState::kHidden),
            (std::array<std::uint16_t, 3>{32928, 32560, 2}));
  EXPECT_EQ(PixelOfFlow({511.98, -511.9}, FlowState::kOutside),
            (std::array<std::uint16_t, 3>{65535, 6, 3}));
}

TEST(ImageFlow, IsUnknownBeyondItsRange) {
  const std::array<std::uint16_t, 3> unknown = {0, 0, 0};
  EXPECT_EQ(PixelOfFlow({513, 0}, FlowState::kSeen), unknown);
  EXPECT_EQ(PixelOfFlow({0, -512.1}, FlowState::kSeen), unknown);
  EXPECT_EQ(PixelOfFlow({1, 1}, FlowState::kUnknown), unknown);
  EXPECT_EQ(FlowAt(PictureOf(unknown), 0, 0).state, FlowState::kUnknown);
}

TEST(ImageFlow, ComesBackToTheRounding) {
  const PixelFlow back = FlowAt(PictureOf(PixelOfFlow({1.237, -0.004}, FlowState::kSeen)), 0, 0);
  EXPECT_EQ(back.state, FlowState::kSeen);
  EXPECT_NEAR(back.flow_px.x(), 1.237, 0.5 / 64);
  EXPECT_NEAR(back.flow_px.y(), -0.004, 0.5 / 64);
}

TEST(SceneFlow, HoldsWholeMillimetres) {
  EXPECT_EQ(PixelOfShift({0.0014, -1.0, 32.7}),
            (std::array<std::uint16_t, 3>{32769, 31768, 65468}));
  EXPECT_EQ(PixelOfShift({33, 0, 0}), (std::array<std::uint16_t, 3>{0, 0, 0}));
}

}  // namespace
}  // namespace tera
