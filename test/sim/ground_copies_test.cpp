#include "sim/ground_copies.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

class Copies : public testing::Test {
 protected:
  void Raise(float to_m) { ground_.Set(30, 30, {to_m, {}}); }

  TerrainSurface ground_{TerrainGrid{.nx = 101, .ny = 101}};
  GroundCopies copies_;
};

TEST_F(Copies, EachStaysAsTheGroundWasWhenItWasAskedFor) {
  const auto level = copies_.Of(ground_);
  Raise(1);
  const auto higher = copies_.Of(ground_);
  Raise(2);
  EXPECT_EQ(level->height_m(30, 30), 0);
  EXPECT_EQ(higher->height_m(30, 30), 1);
  EXPECT_EQ(copies_.Of(ground_)->height_m(30, 30), 2);
}

TEST_F(Copies, OneThatNobodyHoldsServesAgain) {
  const TerrainSurface* first = copies_.Of(ground_).get();
  Raise(1);
  const auto again = copies_.Of(ground_);
  EXPECT_EQ(again.get(), first);
  EXPECT_EQ(again->height_m(30, 30), 1);
  EXPECT_NE(copies_.Of(ground_).get(), first) << "which is held";
}

}  // namespace
}  // namespace tera
