#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tera {

/// True in a thread that runs jobs of an InParallel call together with other threads.
inline thread_local bool shares_jobs = false;

/// Number of idle threads: threads of a running InParallel call that have no job left while other
/// threads of the call still work.
inline std::atomic<int> spare_threads = 0;

/// Reserves up to `most` idle threads for the lifetime of the object.
class BorrowedThreads {
 public:
  explicit BorrowedThreads(std::size_t most) {
    int spare = spare_threads;
    while (count_ < most && spare > 0) {
      if (spare_threads.compare_exchange_weak(spare, spare - 1)) ++count_;
    }
  }
  BorrowedThreads(const BorrowedThreads&) = delete;
  BorrowedThreads& operator=(const BorrowedThreads&) = delete;
  ~BorrowedThreads() { spare_threads += static_cast<int>(count_); }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
};

/// Runs `jobs` jobs and returns their results in job order, independent of the number of threads.
/// If jobs throw, the exception of the lowest-numbered one propagates. A nested call uses its own
/// thread plus idle threads of the enclosing calls, so it adds no running threads.
template <typename Result>
std::vector<Result> InParallel(std::size_t jobs, int threads,
                               const std::function<Result(std::size_t)>& job) {
  std::vector<Result> results(jobs);
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t first_failed = jobs;
  const auto run = [&](std::size_t k) {
    try {
      results[k] = job(k);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (k < first_failed) failure = std::current_exception(), first_failed = k;
      next = jobs;  // all earlier jobs have started
    }
  };
  const bool is_shared = shares_jobs;
  const std::size_t wanted = std::min(jobs, static_cast<std::size_t>(std::max(threads, 1)));
  const BorrowedThreads borrowed(is_shared && wanted > 1 ? wanted - 1 : 0);
  const std::size_t most = is_shared ? 1 + borrowed.count() : wanted;
  std::atomic<int> done = 0;
  const auto work = [&] {
    shares_jobs = is_shared || most > 1;
    for (std::size_t k = next++; k < jobs; k = next++) run(k);
    shares_jobs = is_shared;
    if (is_shared || most == 1) return;
    ++done;
    ++spare_threads;
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < most; ++t) others.emplace_back(work);
    work();
  }
  spare_threads -= done;
  if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace tera
