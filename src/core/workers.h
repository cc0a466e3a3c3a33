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

/// Threads that wait for the next loop, for work that is too short to start threads for: the rows
/// of a picture.
///
/// Model   the loop's places are cut into ranges, which the threads take one after the other; what
///         a range gives must not depend on another, so that the number of threads changes nothing.
/// Omits   loops within loops; one caller at a time.
class Workers {
 public:
  /// `threads` in all, the calling one among them; below 1 counts as 1. Where the computer gives
  /// fewer, with fewer.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// From `begin` up to, not including, `end`.
  using RangeWork = std::function<void(std::size_t begin, std::size_t end)>;
  /// Calls `work` for ranges of at least `least` places, but for the last, that make up 0 to
  /// `count`; returns when all are done. Of those that throw, what one threw is thrown on.
  void ForRanges(std::size_t count, std::size_t least, const RangeWork& work);

 private:
  void Wait();
  void TakeRanges(std::unique_lock<std::mutex>* lock);

  std::mutex mutex_;
  std::condition_variable loop_begins_, loop_ends_;
  const RangeWork* work_ = nullptr;  ///< of the loop under way
  std::size_t next_ = 0, count_ = 0, step_ = 1;
  int busy_ = 0;  ///< threads within a range
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::vector<std::jthread> others_;
};

}  // namespace tera
