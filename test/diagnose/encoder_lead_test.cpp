#include "diagnose/encoder_lead.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/search/toy_block.h"

namespace tera {
namespace {

constexpr std::size_t kSamples = 4000;  // of 0.01 s

/// A block whose rate is what its lever says `ahead` samples later, late by a lag of 50 ms, noisy.
ReplayBlock Ahead(std::uint64_t seed, std::size_t ahead,
                  std::vector<std::size_t> candidates = {3}) {
  const std::vector<double> lever = ToyLever(kSamples + ahead, seed);
  const std::vector<double> response = ToyResponse(lever, 0, 0, 0.05);
  std::vector<double> heard, clean;
  for (std::size_t k = 0; k < kSamples; ++k) {
    heard.push_back(lever[k]);
    clean.push_back(response[k + ahead]);
  }
  return ToyBlock(heard, ToyMeasured(clean, 0.05, seed), candidates);
}

std::vector<ReplayBlock> Both(ReplayBlock a, ReplayBlock b) {
  std::vector<ReplayBlock> blocks;
  blocks.push_back(std::move(a));
  blocks.push_back(std::move(b));
  return blocks;
}

TEST(EncoderLead, IsHowFarTheClockIsOffLessWhatTheDriveLags) {
  const auto lead_s = EncoderLead_s(Both(Ahead(1, 25), Ahead(2, 25)));
  ASSERT_TRUE(lead_s);
  EXPECT_NEAR(*lead_s, 0.20, 0.03);
}

TEST(EncoderLead, IsNoneWhereDrivesOnlyLagOrOneOfThemDoes) {
  EXPECT_FALSE(EncoderLead_s(Both(Ahead(1, 0), Ahead(2, 0))));
  EXPECT_FALSE(EncoderLead_s(Both(Ahead(1, 25), Ahead(2, 0))));
}

TEST(EncoderLead, IsNoneOfOneJointAloneOrWithoutLevers) {
  std::vector<ReplayBlock> one;
  one.push_back(Ahead(1, 25));
  EXPECT_FALSE(EncoderLead_s(one));
  EXPECT_FALSE(EncoderLead_s(Both(Ahead(1, 25, {0}), Ahead(2, 25, {0}))));
}

}  // namespace
}  // namespace tera
