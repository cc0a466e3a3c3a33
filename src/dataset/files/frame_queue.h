#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tera {

/// Worker threads with a bounded queue of jobs.
///
/// Model   jobs start in order and may end in any order; Push blocks while `capacity` jobs wait.
///         The first exception of a job is kept, later jobs are dropped, and the next Push or Drain
///         throws it on the caller's thread. If the system gives fewer threads, these do the work;
///         without any, Push does.
class FrameQueue {
 public:
  FrameQueue(int threads, int capacity);
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;
  /// Drops the jobs that have not started and waits for the others.
  ~FrameQueue();

  void Push(std::function<void()> job);
  /// Waits until every job has ended.
  void Drain();

 private:
  void Work();
  void RethrowLocked();

  const std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable job_waits_, room_or_end_;
  std::deque<std::function<void()>> jobs_;
  int running_ = 0;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> workers_;
};

}  // namespace tera
