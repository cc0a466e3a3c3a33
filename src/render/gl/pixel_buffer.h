#pragma once

#include <cstddef>
#include <span>

#include "render/gl/gl_objects.h"

namespace tera {

/// Memory that a picture is copied into while the program goes on.
class PixelBuffer {
 public:
  PixelBuffer() = default;
  PixelBuffer(const PixelBuffer&) = delete;
  PixelBuffer& operator=(const PixelBuffer&) = delete;
  ~PixelBuffer() { Forget(); }
  /// Begins the copy of a texture, `pixels` of it, to which the OpenGL `format` and `type` give
  /// `pixel_bytes` each. What an earlier copy left is gone.
  void Begin(const GlObject& texture, unsigned format, unsigned type, std::size_t pixels,
             std::size_t pixel_bytes);
  /// What was copied, as values of T; waits until it is there. Good until the next Begin.
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
  void* copied_ = nullptr;  ///< the fence behind the copy, until it has been waited for
};

}  // namespace tera
