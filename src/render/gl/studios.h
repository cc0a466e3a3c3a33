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
/// Model   a studio takes its pictures in the order in which they are ordered, and others take
///         theirs at the same time. A picture is the same in any of them.
class Studios {
 public:
  using Work = std::function<CameraFrame(Rasterizer* rasterizer)>;

  static constexpr int kThreadsOfStudio = 4, kMost = 4;
  /// How many studios make pictures faster: on a GPU one for every kThreadsOfStudio of `threads`,
  /// kMost at most; where OpenGL draws in software, which takes every core for one picture, one.
  static int FittingCount(const EglOptions& egl, int threads);

  /// `beside` studios, which share `threads`; with none, one that takes a picture while it is
  /// ordered. Throws InputError as Rasterizer does.
  Studios(const SceneModel& model, const EglOptions& egl, int threads, int beside);
  /// Pictures under way are finished, those that have not been begun are none.
  ~Studios();
  Studios(const Studios&) = delete;
  Studios& operator=(const Studios&) = delete;

  std::size_t count() const { return studios_.size(); }
  bool work_beside() const { return work_beside_; }
  /// The studio for one more camera: each gets another, as far as they go.
  std::size_t NextForACamera() { return cameras_++ % studios_.size(); }
  /// Orders a picture. What `work` looks at must stay as it is until the picture is there; what it
  /// throws, get() throws.
  std::future<CameraFrame> Take(std::size_t studio, Work work);
  /// Seconds for which the busiest studio has worked; known when no picture is under way.
  double busy_s() const;

 private:
  using Order = std::packaged_task<CameraFrame()>;
  struct Studio {
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
  std::vector<std::unique_ptr<Studio>> studios_;
};

}  // namespace tera
