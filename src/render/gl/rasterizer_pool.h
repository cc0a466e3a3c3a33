#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"

namespace tera {

/// Several rasterizers of one scene, each with its own thread and OpenGL context. They render while
/// the simulation continues.
///
/// Model   each rasterizer processes its requests in order; different rasterizers work
///         concurrently. All of them produce identical images.
class RasterizerPool {
 public:
  using Work = std::function<CameraFrame(Rasterizer* rasterizer)>;

  static constexpr int kThreadsOfEach = 4, kMost = 4;
  /// Largest useful number of rasterizers. A GPU takes one per kThreadsOfEach of `threads`, at most
  /// kMost. Software OpenGL takes one, because one image uses every core.
  static int FittingCount(const EglOptions& egl, int threads);

  /// Creates `beside` concurrent rasterizers that share `threads`. If `beside` is 0, one rasterizer
  /// renders in the calling thread. Throws InputError as Rasterizer does.
  RasterizerPool(const SceneModel& model, const EglOptions& egl, int threads, int beside);
  /// Completes images in progress and drops waiting requests.
  ~RasterizerPool();
  RasterizerPool(const RasterizerPool&) = delete;
  RasterizerPool& operator=(const RasterizerPool&) = delete;

  std::size_t count() const { return workers_.size(); }
  bool work_beside() const { return work_beside_; }
  /// Index of the rasterizer for the next camera, assigned round-robin.
  std::size_t NextForACamera() { return cameras_++ % workers_.size(); }
  /// Requests an image. The inputs of `work` must not change until the image is complete. The
  /// future's get() rethrows an exception of `work`.
  std::future<CameraFrame> Take(std::size_t rasterizer, Work work);
  /// Busy time of the most loaded rasterizer. Valid only while no image is in progress.
  double busy_s() const;

 private:
  using Order = std::packaged_task<CameraFrame()>;
  struct Worker {
    std::unique_ptr<Rasterizer> rasterizer;
    double busy_s = 0;
    std::mutex mutex;
    std::condition_variable is_asked;
    std::deque<Order> orders;
    bool closes = false;
    std::thread thread;  ///< not running if the calling thread renders

    void TakeAll();
  };

  bool work_beside_;
  std::size_t cameras_ = 0;  ///< number of cameras with an assigned rasterizer
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace tera
