#include "render/gl/rasterizer_pool.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/beside.h"
#include "core/check.h"
#include "core/stopwatch.h"
#include "render/gl/egl_context.h"

namespace tera {

int RasterizerPool::FittingCount(const EglOptions& egl, int threads) {
  if (threads < 2 * kThreadsOfEach || EglContext(egl).info().is_software) return 1;
  return std::min(threads / kThreadsOfEach, kMost);
}

RasterizerPool::RasterizerPool(const SceneModel& model, const EglOptions& egl, int threads,
                               int beside)
    : work_beside_(beside > 0) {
  const int count = std::max(beside, 1);
  std::vector<std::future<std::unique_ptr<Rasterizer>>> made;
  for (int s = 0; s < count; ++s) {
    made.push_back(Beside(
        [&] { return std::make_unique<Rasterizer>(model, egl, std::max(threads / count, 1)); }));
  }
  for (auto& rasterizer : made) {
    workers_.emplace_back(std::make_unique<Worker>())->rasterizer = rasterizer.get();
  }
  if (!work_beside_) return;
  try {
    for (const auto& worker : workers_) {
      worker->thread = std::thread([&place = *worker] { place.TakeAll(); });
    }
  } catch (const std::system_error&) {
    // The system provides no further threads; the calling thread renders for the remaining
    // rasterizers.
  }
}

RasterizerPool::~RasterizerPool() {
  for (const auto& worker : workers_) {
    if (!worker->thread.joinable()) continue;
    {
      const std::lock_guard lock(worker->mutex);
      worker->closes = true;
    }
    worker->is_asked.notify_one();
    worker->thread.join();
  }
}

std::future<CameraFrame> RasterizerPool::Take(std::size_t rasterizer, Work work) {
  TERA_CHECK(rasterizer < workers_.size(), rasterizer, workers_.size());
  Worker& place = *workers_[rasterizer];
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

/// Renders requests until the pool closes.
void RasterizerPool::Worker::TakeAll() {
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

double RasterizerPool::busy_s() const {
  double most_s = 0;
  for (const auto& worker : workers_) most_s = std::max(most_s, worker->busy_s);
  return most_s;
}

}  // namespace tera
