#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "dataset/files/frame_queue.h"

namespace tera {

/// Runs work in parallel and delivers the results in the order of submission.
///
/// Model   `threads` threads do the work; the caller's thread takes the results, within its calls.
///         Results, their order, and the exception thrown by the work are thus independent of the
///         number of threads. An exception of the caller may precede those of pending work. Give
///         waits while more than kPerThread pieces per thread are pending, which bounds the memory.
template <typename Result>
class InOrder {
 public:
  static constexpr int kPerThread = 2;

  InOrder(int threads, std::function<void(Result)> take)
      : most_(kPerThread * threads),
        take_(std::move(take)),
        queue_(threads, kPerThread * threads) {}

  /// Starts `work`, and takes finished results that are next. An exception of the work is thrown in
  /// place of its result; no call may follow it.
  void Give(std::function<Result()> work) {
    auto task = std::make_shared<std::packaged_task<Result()>>(std::move(work));
    pending_.push_back({std::nullopt, task->get_future()});
    ++working_;
    queue_.Push([task] { (*task)(); });
    TakeDone();
  }
  /// Adds a result without work, after all submitted work.
  void GiveResult(Result result) {
    pending_.push_back({std::move(result), {}});
    TakeDone();
  }
  /// Waits for all submitted work.
  void Finish() {
    while (!pending_.empty()) TakeFirst();
  }

 private:
  struct Piece {
    std::optional<Result> result;  ///< set for results without work
    std::future<Result> work;
  };

  void TakeDone() {
    while (!pending_.empty() && (working_ > most_ || IsDone(pending_.front()))) TakeFirst();
  }
  static bool IsDone(const Piece& piece) {
    return piece.result ||
           piece.work.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }
  void TakeFirst() {
    Piece first = std::move(pending_.front());
    pending_.pop_front();
    if (first.result) return take_(std::move(*first.result));
    --working_;
    take_(first.work.get());
  }

  const int most_;
  std::function<void(Result)> take_;
  std::deque<Piece> pending_;
  int working_ = 0;   ///< number of pending results with work
  FrameQueue queue_;  ///< last, so that all work ends before the other members are destroyed
};

}  // namespace tera
