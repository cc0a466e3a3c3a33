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

/// Whether the calling thread shares the jobs of an InParallel with others.
inline thread_local bool shares_jobs = false;

/// Results in the order of jobs, whatever the number of threads. Of jobs that throw, the exception
/// of the first is thrown on. A job's own jobs run on its thread, unless it is alone.
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
      next = jobs;  // those before it have begun
    }
  };
  const bool is_shared = shares_jobs;
  const std::size_t most =
      is_shared ? 1 : std::min(jobs, static_cast<std::size_t>(std::max(threads, 1)));
  const auto work = [&] {
    shares_jobs = is_shared || most > 1;
    for (std::size_t k = next++; k < jobs; k = next++) run(k);
    shares_jobs = is_shared;
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < most; ++t) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace tera
