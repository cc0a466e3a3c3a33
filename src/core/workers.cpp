#include "core/workers.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace tera {
namespace {

constexpr std::size_t kRangesPerThread = 2;  ///< more ranges than threads limit the delay by a
                                             ///< thread that starts late

}  // namespace

Workers::Workers(int threads) {
  try {
    for (int t = 1; t < threads; ++t) others_.emplace_back([this] { Wait(); });
  } catch (const std::system_error&) {
    // The system provides no more threads. The loops run on the existing ones.
  }
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  loop_begins_.notify_all();
}

void Workers::ForRanges(std::size_t count, std::size_t least, const RangeWork& work) {
  if (count == 0) return;
  const std::size_t ranges = kRangesPerThread * (others_.size() + 1);
  const std::size_t step = std::max({(count + ranges - 1) / ranges, least, std::size_t{1}});
  if (others_.empty() || step >= count) return work(0, count);
  std::unique_lock lock(mutex_);
  work_ = &work;
  next_ = 0;
  count_ = count;
  step_ = step;
  const std::size_t helpers = std::min((count + step - 1) / step - 1, others_.size());
  for (std::size_t h = 0; h < helpers; ++h) loop_begins_.notify_one();
  TakeRanges(&lock);
  loop_ends_.wait(lock, [this] { return busy_ == 0; });
  work_ = nullptr;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Workers::Wait() {
  std::unique_lock lock(mutex_);
  while (true) {
    loop_begins_.wait(lock, [this] { return stopping_ || next_ < count_; });
    if (stopping_) return;
    TakeRanges(&lock);
    if (busy_ == 0) loop_ends_.notify_one();
  }
}

/// Runs ranges until none is left. Releases `lock` while a range runs.
void Workers::TakeRanges(std::unique_lock<std::mutex>* lock) {
  while (next_ < count_) {
    const std::size_t begin = next_, end = std::min(begin + step_, count_);
    next_ = end;
    const RangeWork& work = *work_;
    ++busy_;
    lock->unlock();
    std::exception_ptr failure;
    try {
      work(begin, end);
    } catch (...) {
      failure = std::current_exception();
    }
    lock->lock();
    --busy_;
    if (failure && !failure_) {
      failure_ = failure;
      next_ = count_;
    }
  }
}

}  // namespace tera
