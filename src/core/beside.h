#pragma once

#include <future>
#include <utility>

namespace tera {

/// Starts `work` on its own thread. get() on the returned future waits for the result or rethrows
/// the exception. If the system provides no thread, get() runs the work in the calling thread.
template <typename Work>
auto Beside(Work work) {
  return std::async(std::launch::async | std::launch::deferred, std::move(work));
}

}  // namespace tera
