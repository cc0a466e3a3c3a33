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

/// Work that is done side by side, and whose results are taken one after the other, in the order in
/// which it was given.
///
/// Model   `threads` threads do the work; the caller's thread takes the results, within its calls.
///         So what is taken, in which order, and which fault of work is thrown, is the same for any
///         number of threads; a fault of who gives the work may come before those of work that was
///         given and not taken. While more than kPerThread pieces a thread are not taken, Give
///         waits: no more of their results are in memory.
template <typename Result>
class InOrder {
 public:
  static constexpr int kPerThread = 2;

  InOrder(int threads, std::function<void(Result)> take)
      : most_(kPerThread * threads),
        take_(std::move(take)),
        queue_(threads, kPerThread * threads) {}

  /// Begins `work`, and takes what is done and next. What work throws is thrown where its result
  /// would have been taken; then this is of no use any more.
  void Give(std::function<Result()> work) {
    auto task = std::make_shared<std::packaged_task<Result()>>(std::move(work));
    pending_.push_back({std::nullopt, task->get_future()});
    ++working_;
    queue_.Push([task] { (*task)(); });
    TakeDone();
  }
  /// A result that needs no work, behind those of the work given before it.
  void GiveResult(Result result) {
    pending_.push_back({std::move(result), {}});
    TakeDone();
  }
  /// Waits for all that was given.
  void Finish() {
    while (!pending_.empty()) TakeFirst();
  }

 private:
  struct Piece {
    std::optional<Result> result;  ///< where it needs no work
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
  int working_ = 0;   ///< of the pending ones, those that are work
  FrameQueue queue_;  ///< last, so that no work is left when the rest goes
};

}  // namespace tera
