#pragma once

#include <cstddef>
#include <span>

#include "render/gl/gl_objects.h"

namespace tera {

/// Receives an asynchronous copy of a GPU image.
class PixelBuffer {
 public:
  PixelBuffer() = default;
  PixelBuffer(const PixelBuffer&) = delete;
  PixelBuffer& operator=(const PixelBuffer&) = delete;
  ~PixelBuffer() { Forget(); }
  /// Starts a copy of `pixels` pixels of a texture; it replaces the previous copy. OpenGL `format`
  /// and `type` have `pixel_bytes` per pixel.
  void Begin(const GlObject& texture, unsigned format, unsigned type, std::size_t pixels,
             std::size_t pixel_bytes);
  /// Waits for the copy and returns it. The span is valid until the next Begin.
  template <typename T>
  std::span<const T> Read() {
    Wait();
    return {static_cast<const T*>(mapped_), bytes_ / sizeof(T)};
  }

 private:
  void Wait();
  void Forget();

  GlObject buffer_;
  const void* mapped_ = nullptr;
  std::size_t bytes_ = 0, room_ = 0;
  void* copied_ = nullptr;  ///< fence of a copy in progress
};

}  // namespace tera
