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

/// Runs jobs in parallel and delivers their results in the order of submission.
///
/// Model   `threads` worker threads run the jobs. The calling thread passes results to `take`
///         during its calls of Give and Finish. The results, their order and the exception of a
///         failed job thus do not depend on the number of threads. An exception of the calling
///         thread may overtake pending jobs. Give blocks while kPerThread jobs per thread are
///         pending, which bounds the memory.
template <typename Result>
class InOrder {
 public:
  static constexpr int kPerThread = 2;

  InOrder(int threads, std::function<void(Result)> take)
      : most_(kPerThread * threads),
        take_(std::move(take)),
        queue_(threads, kPerThread * threads) {}

  /// Starts `work` and delivers results that are ready. If a job threw, its exception is thrown in
  /// place of its result; no call may follow.
  void Give(std::function<Result()> work) {
    auto task = std::make_shared<std::packaged_task<Result()>>(std::move(work));
    pending_.push_back({std::nullopt, task->get_future()});
    ++working_;
    queue_.Push([task] { (*task)(); });
    TakeDone();
  }
  /// Appends a finished result after all submitted jobs.
  void GiveResult(Result result) {
    pending_.push_back({std::move(result), {}});
    TakeDone();
  }
  /// Waits for all jobs and delivers their results.
  void Finish() {
    while (!pending_.empty()) TakeFirst();
  }

 private:
  struct Piece {
    std::optional<Result> result;  ///< set for a result given without a job
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
  int working_ = 0;   ///< number of pending results that have a job
  FrameQueue queue_;  ///< the last member: its threads must end before other members are destroyed
};

}  // namespace tera
