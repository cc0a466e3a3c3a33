#pragma once

#include "render/gl/egl_options.h"

namespace tera {

/// An OpenGL 4.5 core context without a window.
///
/// Model   uses EGL's device platform if a device is a GPU, otherwise Mesa's surfaceless platform
///         with software rendering. The context is current only while a Current exists. Different
///         threads may therefore use a rasterizer one after the other.
class EglContext {
 public:
  /// Throws InputError if no context is available, with the tried platforms and a remedy.
  explicit EglContext(const EglOptions& options);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  const GlInfo& info() const { return info_; }

  /// Makes the context current for a scope. At most one software context per process is current at
  /// a time; others wait. Mesa's renderer (22.3) occasionally crashes if two contexts of one
  /// display draw concurrently, and it uses every core for one context anyway.
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
