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
/// Model   Jobs start in order and may end in any order. Push blocks while `capacity` jobs wait.
///         After a job throws, the remaining jobs are dropped; the next Push or Drain throws the
///         exception on the calling thread. If the system provides fewer threads, the queue uses
///         fewer; without any thread, Push runs the job itself.
class FrameQueue {
 public:
  FrameQueue(int threads, int capacity);
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;
  /// Drops jobs that have not started and waits for running jobs.
  ~FrameQueue();

  void Push(std::function<void()> job);
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
