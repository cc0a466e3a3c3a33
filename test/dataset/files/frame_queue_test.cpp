#include "dataset/files/frame_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/error.h"

namespace tera {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(FrameQueue, ThrowsAWorkersFaultOnTheCallersThread) {
  FrameQueue queue(2, 4);
  queue.Push([] { throw InputError("disk gone"); });
  EXPECT_THAT([&] { queue.Drain(); }, ThrowsMessage<InputError>(HasSubstr("disk gone")));
  EXPECT_THAT([&] { queue.Push([] {}); }, ThrowsMessage<InputError>(HasSubstr("disk gone")));
}

TEST(FrameQueue, HoldsTheCallerBackWhileItIsFull) {
  std::atomic<int> started = 0;
  std::atomic<bool> go = false;
  FrameQueue queue(1, 2);
  const auto job = [&] {
    ++started;
    while (!go) std::this_thread::yield();
  };
  std::atomic<int> pushed = 0;
  std::thread caller([&] {
    for (int i = 0; i < 6; ++i) {
      queue.Push(job);
      ++pushed;
    }
  });
  while (started < 1 || pushed < 3) std::this_thread::yield();
  EXPECT_LE(pushed, 3);  // one runs, two wait; the fourth is held back
  go = true;
  caller.join();
  queue.Drain();
  EXPECT_EQ(started, 6);
}

}  // namespace
}  // namespace tera
