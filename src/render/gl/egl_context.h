#pragma once

#include "render/gl/egl_options.h"

namespace tera {

/// An OpenGL 4.5 core context without a window.
///
/// Model   EGL's device platform if a device is a GPU, otherwise Mesa's surfaceless platform with
///         software rendering. The context is current only during the life of a Current. Any thread
///         may therefore use a rasterizer, but only a single thread at a time.
class EglContext {
 public:
  /// Throws InputError with the tried platforms and the remedy if no context is available.
  explicit EglContext(const EglOptions& options);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  const GlInfo& info() const { return info_; }

  /// Makes the context current for a scope. Software contexts take turns, at most a single context
  /// per process at a time. Mesa's renderer (22.3) occasionally crashes if two contexts of one
  /// display draw concurrently, and already uses every core for one context.
  class Current {
   public:
    explicit Current(const EglContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    /// Release lets another thread use the context; Take makes it current again.
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
