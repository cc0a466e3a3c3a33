#include "dataset/export/nuscenes/key_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tera {
namespace {

using testing::ElementsAre;

constexpr TimeNs kMs = 1'000'000;

std::vector<TimeNs> Ms(std::initializer_list<TimeNs> times) {
  std::vector<TimeNs> t_ns;
  for (const TimeNs t : times) t_ns.push_back(t * kMs);
  return t_ns;
}

TEST(KeyFrames, SamplesAreAPeriodApartButForJitter) {
  EXPECT_THAT(SampleTimes(Ms({50, 150, 248, 360, 549, 1000}), 200 * kMs),
              ElementsAre(50 * kMs, 360 * kMs, 1000 * kMs));
  EXPECT_THAT(SampleTimes({0, 199 * kMs + 1, 400 * kMs}, 200 * kMs),
              ElementsAre(0, 199 * kMs + 1, 400 * kMs));
  EXPECT_TRUE(SampleTimes({}, kMs).empty());
}

TEST(KeyFrames, TheNearestIsTheEarlierOfTwo) {
  EXPECT_FALSE(NearestOf({}, 3));
  EXPECT_EQ(NearestOf({0, 10}, -5), 0u);
  EXPECT_EQ(NearestOf({0, 10}, 5), 0u);
  EXPECT_EQ(NearestOf({0, 10}, 6), 1u);
  EXPECT_EQ(NearestOf({0, 10}, 99), 1u);
}

std::vector<std::pair<std::size_t, bool>> Told(const std::vector<FrameOfSample>& frames) {
  std::vector<std::pair<std::size_t, bool>> told;
  for (const FrameOfSample& f : frames) told.emplace_back(f.sample, f.is_key);
  return told;
}

// Samples at 0, 500 and 1000 ms. The camera's pictures at 460 and 530 are both nearest to the
// second, which is nearer to the latter. 300 has no sample before it in reach and leads to the
// second. 1300 is after all, and further from the last than a frame may be.
TEST(KeyFrames, AFrameIsKeyWhereItAndItsSampleAreNearestToEachOther) {
  EXPECT_THAT(Told(FramesOfSamples(Ms({10, 300, 460, 530, 1300}), Ms({0, 500, 1000}), 200 * kMs)),
              ElementsAre(std::pair(0u, true), std::pair(1u, false), std::pair(1u, false),
                          std::pair(1u, true), std::pair(2u, false)));
}

// A camera of 1 Hz has no key frame at every second sample, and none at two samples.
TEST(KeyFrames, ASlowSensorHasKeyFramesAtSomeSamples) {
  EXPECT_THAT(Told(FramesOfSamples(Ms({0, 1000}), Ms({0, 500, 1000}), 500 * kMs)),
              ElementsAre(std::pair(0u, true), std::pair(2u, true)));
}

}  // namespace
}  // namespace tera
