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

/// Where pictures of one scene are taken: rasterizers that share nothing, each with a thread and an
/// OpenGL context of its own, beside a run that goes on.
///
/// Model   a rasterizer takes its pictures in the order in which they are ordered, and others take
///         theirs at the same time. A picture is the same in any of them.
class RasterizerPool {
 public:
  using Work = std::function<CameraFrame(Rasterizer* rasterizer)>;

  static constexpr int kThreadsOfEach = 4, kMost = 4;
  /// How many rasterizers make pictures faster: on a GPU one for every kThreadsOfEach of `threads`,
  /// kMost at most; where OpenGL draws in software, which takes every core for one picture, one.
  static int FittingCount(const EglOptions& egl, int threads);

  /// `beside` rasterizers, which share `threads`; with none, one that takes a picture while it is
  /// ordered. Throws InputError as Rasterizer does.
  RasterizerPool(const SceneModel& model, const EglOptions& egl, int threads, int beside);
  /// Pictures under way are finished, those that have not been begun are none.
  ~RasterizerPool();
  RasterizerPool(const RasterizerPool&) = delete;
  RasterizerPool& operator=(const RasterizerPool&) = delete;

  std::size_t count() const { return workers_.size(); }
  bool work_beside() const { return work_beside_; }
  /// The rasterizer for one more camera: each gets another, as far as they go.
  std::size_t NextForACamera() { return cameras_++ % workers_.size(); }
  /// Orders a picture. What `work` looks at must stay as it is until the picture is there; what it
  /// throws, get() throws.
  std::future<CameraFrame> Take(std::size_t rasterizer, Work work);
  /// Seconds for which the busiest rasterizer has worked; known when no picture is under way.
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
    std::thread thread;  ///< none where the caller's takes the pictures

    void TakeAll();
  };

  bool work_beside_;
  std::size_t cameras_ = 0;  ///< that got one
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace tera
