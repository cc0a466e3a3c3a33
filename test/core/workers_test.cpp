#include "core/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <vector>

namespace tera {
namespace {

TEST(Workers, TakeEachPlaceOnceForAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 3, 16}) {
    Workers workers(threads);
    for (const std::size_t count : {0, 1, 7, 64, 1000}) {
      std::vector<std::atomic<int>> taken(count);
      workers.ForRanges(count, 5, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) ++taken[k];
      });
      for (std::size_t k = 0; k < count; ++k) {
        EXPECT_EQ(taken[k], 1) << k << " of " << count << " on " << threads;
      }
    }
  }
}

TEST(Workers, CutNoRangeShorterThanAskedForButTheLast) {
  Workers workers(4);
  std::atomic<int> short_ones = 0;
  workers.ForRanges(1000, 300, [&](std::size_t begin, std::size_t end) {
    if (end - begin < 300) ++short_ones;
    EXPECT_TRUE(end - begin >= 300 || end == 1000);
  });
  EXPECT_LE(short_ones, 1);
}

TEST(Workers, WorkAtTheSameTime) {
  Workers workers(2);
  std::atomic<int> begun = 0, met = 0;
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  workers.ForRanges(4, 2, [&](std::size_t, std::size_t) {
    ++begun;
    while (begun < 2 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    if (begun == 2) ++met;
  });
  EXPECT_EQ(met, 2) << "ranges that the other one joined before they ended";
}

TEST(Workers, ThrowOnWhatARangeThrewAndGoOnAfterwards) {
  Workers workers(3);
  const auto fail = [&] {
    workers.ForRanges(100, 1, [](std::size_t begin, std::size_t) {
      if (begin > 0) throw std::runtime_error("a range");
    });
  };
  EXPECT_THROW(fail(), std::runtime_error);
  std::atomic<std::size_t> sum = 0;
  workers.ForRanges(100, 1, [&](std::size_t begin, std::size_t end) { sum += end - begin; });
  EXPECT_EQ(sum, 100u);
}

}  // namespace
}  // namespace tera
