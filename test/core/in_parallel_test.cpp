#include "core/in_parallel.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>

namespace tera {
namespace {

/// Waits for a condition set by other threads; false after a timeout.
bool Await(const std::function<bool()>& is_so) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!is_so()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::yield();
  }
  return true;
}

TEST(InParallel, GivesResultsInTheOrderOfJobsForAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 3, 16}) {
    const auto squares =
        InParallel<int>(7, threads, [](std::size_t k) { return static_cast<int>(k * k); });
    EXPECT_EQ(squares, (std::vector<int>{0, 1, 4, 9, 16, 25, 36})) << threads;
  }
  EXPECT_TRUE(InParallel<int>(0, 4, [](std::size_t) { return 1; }).empty());
}

TEST(InParallel, ThrowsWhatTheFirstOfTheJobsThatFailThrew) {
  std::atomic<int> begun = 0;
  try {
    InParallel<int>(2, 2, [&](std::size_t k) -> int {
      ++begun;
      Await([&] { return begun == 2; });
      throw std::runtime_error(std::to_string(k));
    });
    FAIL() << "no job's exception came through";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "0");
  }
  EXPECT_EQ(spare_threads, 0);
}

TEST(InParallel, RunsAJobsOwnJobsOnItsThreadWhileAllOthersAreBusy) {
  std::atomic<int> begun = 0, ended = 0;
  const auto alone = InParallel<int>(2, 2, [&](std::size_t) {
    ++begun;
    Await([&] { return begun == 2; });
    const auto own =
        InParallel<std::thread::id>(8, 2, [](std::size_t) { return std::this_thread::get_id(); });
    const bool all = std::all_of(own.begin(), own.end(), [](std::thread::id id) {
      return id == std::this_thread::get_id();
    });
    ++ended;
    Await([&] { return ended == 2; });
    return all ? 1 : 0;
  });
  EXPECT_EQ(alone, (std::vector<int>{1, 1}));
}

TEST(InParallel, LendsTheThreadsThatAreDoneToTheJobsOfTheOthers) {
  const auto together = InParallel<int>(2, 2, [&](std::size_t k) {
    if (k == 0) return 2;
    if (!Await([] { return spare_threads > 0; })) return 0;
    std::atomic<int> at_once = 0;
    const auto met = InParallel<int>(2, 2, [&](std::size_t) {
      ++at_once;
      return Await([&] { return at_once == 2; }) ? 1 : 0;
    });
    return met[0] + met[1];
  });
  EXPECT_EQ(together, (std::vector<int>{2, 2}));
  EXPECT_EQ(spare_threads, 0);
}

}  // namespace
}  // namespace tera
