#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tera {

/// Persistent threads that wait for the next loop. They serve work too short for thread creation,
/// such as the rows of an image.
///
/// Model   the threads take ranges of the loop in order. The result of a range must not depend on
///         another range, so that the number of threads does not change the result.
/// Omits   nested loops; only a single caller may run a loop at a time.
class Workers {
 public:
  /// `threads` includes the calling thread; values below 1 count as 1. If the system provides fewer
  /// threads, the loops use fewer.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Works on the half-open range [begin, end).
  using RangeWork = std::function<void(std::size_t begin, std::size_t end)>;
  /// Calls `work` for consecutive ranges that cover 0 to `count` and returns when all are done.
  /// Each range but the last has at least `least` places. If ranges throw, one exception
  /// propagates.
  void ForRanges(std::size_t count, std::size_t least, const RangeWork& work);

 private:
  void Wait();
  void TakeRanges(std::unique_lock<std::mutex>* lock);

  std::mutex mutex_;
  std::condition_variable loop_begins_, loop_ends_;
  const RangeWork* work_ = nullptr;  ///< work of the current loop
  std::size_t next_ = 0, count_ = 0, step_ = 1;
  int busy_ = 0;  ///< threads that work on a range
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::vector<std::jthread> others_;
};

}  // namespace tera
