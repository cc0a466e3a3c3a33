#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tera {

/// Whether the calling thread works on a job of InParallel.
inline thread_local bool is_on_job = false;

/// Results in the order of jobs, whatever the number of threads. The first exception is thrown on.
/// A job's own jobs run on its thread.
template <typename Result>
std::vector<Result> InParallel(std::size_t jobs, int threads,
                               const std::function<Result(std::size_t)>& job) {
  std::vector<Result> results(jobs);
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const bool is_nested = is_on_job;
  const auto work = [&] {
    is_on_job = true;
    try {
      for (std::size_t k = next++; k < jobs; k = next++) results[k] = job(k);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
    is_on_job = is_nested;
  };
  {
    std::vector<std::jthread> others;
    for (int t = 1; t < threads && !is_nested; ++t) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace tera
