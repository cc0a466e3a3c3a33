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

/// Independent rasterizers for images of one scene, each with its own thread and OpenGL context.
/// They work concurrently with a run.
///
/// Model   each rasterizer renders its images in order of request; different rasterizers work
///         concurrently. Every rasterizer produces the same image.
class RasterizerPool {
 public:
  using Work = std::function<CameraFrame(Rasterizer* rasterizer)>;

  static constexpr int kThreadsOfEach = 4, kMost = 4;
  /// Number of rasterizers that increases throughput. A GPU takes one per kThreadsOfEach of
  /// `threads`, at most kMost. Software OpenGL takes one, since one image uses every core.
  static int FittingCount(const EglOptions& egl, int threads);

  /// `beside` concurrent rasterizers share `threads`. With 0, a single rasterizer renders in the
  /// calling thread. Throws InputError as Rasterizer does.
  RasterizerPool(const SceneModel& model, const EglOptions& egl, int threads, int beside);
  /// Finishes started images and drops waiting ones.
  ~RasterizerPool();
  RasterizerPool(const RasterizerPool&) = delete;
  RasterizerPool& operator=(const RasterizerPool&) = delete;

  std::size_t count() const { return workers_.size(); }
  bool work_beside() const { return work_beside_; }
  /// Rasterizer index for the next camera, round-robin.
  std::size_t NextForACamera() { return cameras_++ % workers_.size(); }
  /// Requests an image. The inputs of `work` must not change until the image exists. get() rethrows
  /// its exception.
  std::future<CameraFrame> Take(std::size_t rasterizer, Work work);
  /// Busy seconds of the most loaded rasterizer; valid while no image is in progress.
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
  std::size_t cameras_ = 0;  ///< number of assigned cameras
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace tera
