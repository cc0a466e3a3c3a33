#pragma once

#include "render/gl/egl_options.h"

namespace tera {

/// An OpenGL 4.5 core context without a window.
///
/// Model   EGL's device platform where a device is a GPU, else Mesa's surfaceless platform, which
///         draws in software. The context is current only within the life of a Current, so that a
///         rasterizer may be used from any thread, one at a time.
class EglContext {
 public:
  /// Throws InputError, naming what was tried and the remedy, if there is no such context.
  explicit EglContext(const EglOptions& options);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  const GlInfo& info() const { return info_; }

  /// Makes the context current for a scope. Contexts that draw in software take turns, one at a
  /// time in the process: Mesa's renderer (22.3) crashes now and then where two contexts of one
  /// display draw at once, and uses every core for one anyway.
  class Current {
   public:
    explicit Current(const EglContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    /// Lets another thread use the context, and takes it again.
    void Release();
    void Take();

   private:
    void* display_;
    void* context_;
    bool takes_turns_;
    bool is_taken_ = false;
  };

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  GlInfo info_;
};

}  // namespace tera
