#include "render/gl/studios.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/beside.h"
#include "core/check.h"
#include "core/stopwatch.h"
#include "render/gl/egl_context.h"

namespace tera {

int Studios::FittingCount(const EglOptions& egl, int threads) {
  if (threads < 2 * kThreadsOfStudio || EglContext(egl).info().is_software) return 1;
  return std::min(threads / kThreadsOfStudio, kMost);
}

Studios::Studios(const SceneModel& model, const EglOptions& egl, int threads, int beside)
    : work_beside_(beside > 0) {
  const int count = std::max(beside, 1);
  std::vector<std::future<std::unique_ptr<Rasterizer>>> made;
  for (int s = 0; s < count; ++s) {
    made.push_back(Beside(
        [&] { return std::make_unique<Rasterizer>(model, egl, std::max(threads / count, 1)); }));
  }
  for (auto& rasterizer : made) {
    studios_.emplace_back(std::make_unique<Studio>())->rasterizer = rasterizer.get();
  }
  if (!work_beside_) return;
  try {
    for (const auto& studio : studios_) {
      studio->thread = std::thread([&place = *studio] { place.TakeAll(); });
    }
  } catch (const std::system_error&) {
    // The computer gives no more threads; the caller's takes the pictures of the others.
  }
}

Studios::~Studios() {
  for (const auto& studio : studios_) {
    if (!studio->thread.joinable()) continue;
    {
      const std::lock_guard lock(studio->mutex);
      studio->closes = true;
    }
    studio->is_asked.notify_one();
    studio->thread.join();
  }
}

std::future<CameraFrame> Studios::Take(std::size_t studio, Work work) {
  TERA_CHECK(studio < studios_.size(), studio, studios_.size());
  Studio& place = *studios_[studio];
  Order order([&place, work = std::move(work)] {
    const Stopwatch watch(&place.busy_s);
    return work(place.rasterizer.get());
  });
  std::future<CameraFrame> frame = order.get_future();
  if (!place.thread.joinable()) {
    order();
    return frame;
  }
  {
    const std::lock_guard lock(place.mutex);
    place.orders.push_back(std::move(order));
  }
  place.is_asked.notify_one();
  return frame;
}

/// Until the studio closes.
void Studios::Studio::TakeAll() {
  std::unique_lock lock(mutex);
  while (true) {
    is_asked.wait(lock, [this] { return closes || !orders.empty(); });
    if (closes) return;
    Order order = std::move(orders.front());
    orders.pop_front();
    lock.unlock();
    order();
    lock.lock();
  }
}

double Studios::busy_s() const {
  double most_s = 0;
  for (const auto& studio : studios_) most_s = std::max(most_s, studio->busy_s);
  return most_s;
}

}  // namespace tera
