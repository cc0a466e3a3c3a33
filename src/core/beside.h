#pragma once

#include <future>
#include <utility>

namespace tera {

/// Starts `work` on a separate thread. get() of the returned future waits for the result and
/// rethrows an exception of `work`. If the system provides no thread, get() itself runs `work`.
template <typename Work>
auto Beside(Work work) {
  return std::async(std::launch::async | std::launch::deferred, std::move(work));
}

}  // namespace tera
