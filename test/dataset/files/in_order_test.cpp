#include "dataset/files/in_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "core/error.h"

namespace tera {
namespace {

using testing::ElementsAre;

TEST(InOrder, TakesAsGivenThoughTheFirstIsDoneLast) {
  std::vector<int> taken;
  std::atomic<bool> second_is_done = false;
  InOrder<int> numbers(2, [&](int number) { taken.push_back(number); });
  numbers.Give([&] {
    while (!second_is_done) std::this_thread::yield();
    return 1;
  });
  numbers.Give([&] {
    second_is_done = true;
    return 2;
  });
  numbers.GiveResult(3);
  numbers.Finish();
  EXPECT_THAT(taken, ElementsAre(1, 2, 3));
}

TEST(InOrder, TakesAtOnceWhatNeedsNoWork) {
  std::vector<int> taken;
  InOrder<int> numbers(2, [&](int number) { taken.push_back(number); });
  numbers.GiveResult(7);
  EXPECT_THAT(taken, ElementsAre(7));
}

TEST(InOrder, ThrowsTheFaultOfTheFirstThatFailsAndTakesThoseBeforeIt) {
  for (const int threads : {1, 3}) {
    std::vector<int> taken;
    std::atomic<bool> third_has_failed = false;
    const auto give_all = [&] {
      InOrder<int> numbers(threads, [&](int number) { taken.push_back(number); });
      numbers.Give([] { return 1; });
      numbers.Give([&]() -> int {
        while (threads > 1 && !third_has_failed) std::this_thread::yield();
        throw InputError("the second");
      });
      numbers.Give([&]() -> int {
        third_has_failed = true;
        throw InputError("the third");
      });
      numbers.Finish();
    };
    EXPECT_THAT(give_all, testing::ThrowsMessage<InputError>("the second"));
    EXPECT_THAT(taken, ElementsAre(1));
  }
}

TEST(InOrder, HoldsNoMoreResultsThanTwoForEachThread) {
  constexpr int kThreads = 2, kPieces = 50, kMost = kThreads * InOrder<int>::kPerThread;
  int taken = 0;
  std::atomic<int> begun = 0;
  std::atomic<bool> may_end = false;
  std::thread giver([&] {
    InOrder<int> numbers(kThreads, [&](int number) { taken = number; });
    for (int k = 1; k <= kPieces; ++k) {
      numbers.Give([&, k] {
        ++begun;
        while (k == 1 && !may_end) std::this_thread::yield();
        return k;
      });
    }
    numbers.Finish();
  });
  // While the first piece is unfinished, the first piece beyond the limit is the last one accepted.
  while (begun < kMost + 1) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(begun, kMost + 1);
  may_end = true;
  giver.join();
  EXPECT_EQ(taken, kPieces);
  EXPECT_EQ(begun, kPieces);
}

TEST(InOrder, WaitsForWorkUnderWayWhenItGoes) {
  std::atomic<bool> has_begun = false, has_ended = false;
  {
    InOrder<int> numbers(1, [](int) {});
    numbers.Give([&] {
      has_begun = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      has_ended = true;
      return 0;
    });
    while (!has_begun) std::this_thread::yield();
  }
  EXPECT_TRUE(has_ended);
}

}  // namespace
}  // namespace tera
