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

/// A thread pool for parallel loops that are too short to start new threads each time, such as the
/// rows of an image.
///
/// Model   Threads take consecutive index ranges of the loop. The result of a range must not depend
///         on other ranges; then the number of threads does not affect the result.
/// Omits   nested loops and concurrent callers.
class Workers {
 public:
  /// `threads` includes the calling thread; values below 1 mean 1. The pool is smaller if the
  /// system cannot start enough threads.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Works on the half-open range [begin, end).
  using RangeWork = std::function<void(std::size_t begin, std::size_t end)>;
  /// Calls `work` on consecutive ranges that cover [0, count) and waits for all of them. Each range
  /// except the last has at least `least` indices. If several calls throw, one of the exceptions
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
