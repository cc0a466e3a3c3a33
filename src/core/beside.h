#pragma once

#include <future>
#include <utility>

namespace tera {

/// Begins `work` on a thread of its own while the caller goes on; get() of what is returned waits
/// for its result, or throws on what it threw. Where the computer gives no thread, get() does the
/// work.
template <typename Work>
auto Beside(Work work) {
  return std::async(std::launch::async | std::launch::deferred, std::move(work));
}

}  // namespace tera
