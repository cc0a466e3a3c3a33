#include "dataset/files/frame_queue.h"

#include <system_error>

#include "core/check.h"

namespace tera {

FrameQueue::FrameQueue(int threads, int capacity) : capacity_(static_cast<std::size_t>(capacity)) {
  TERA_CHECK(threads >= 1 && capacity >= 1, threads, capacity);
  try {
    for (int i = 0; i < threads; ++i) workers_.emplace_back([this] { Work(); });
  } catch (const std::system_error&) {
    // The system provides no more threads. The existing threads, or the caller's, run the jobs.
  }
}

FrameQueue::~FrameQueue() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    jobs_.clear();
  }
  job_waits_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void FrameQueue::Push(std::function<void()> job) {
  if (workers_.empty()) return job();
  std::unique_lock lock(mutex_);
  room_or_end_.wait(lock, [this] { return failure_ || jobs_.size() < capacity_; });
  RethrowLocked();
  jobs_.push_back(std::move(job));
  lock.unlock();
  job_waits_.notify_one();
}

void FrameQueue::Drain() {
  std::unique_lock lock(mutex_);
  room_or_end_.wait(lock, [this] { return jobs_.empty() && running_ == 0; });
  RethrowLocked();
}

void FrameQueue::RethrowLocked() {
  if (failure_) std::rethrow_exception(failure_);
}

void FrameQueue::Work() {
  std::unique_lock lock(mutex_);
  while (true) {
    job_waits_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    const std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    ++running_;
    room_or_end_.notify_all();
    lock.unlock();
    std::exception_ptr failure;
    try {
      job();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    --running_;
    if (failure && !failure_) {
      failure_ = failure;
      jobs_.clear();
    }
    room_or_end_.notify_all();
  }
}

}  // namespace tera
