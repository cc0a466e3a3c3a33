#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/motion.h"

/// Owners of OpenGL objects. Each operation needs a current context, destruction included.

namespace tera {

/// Owns an OpenGL object, which its name (id) identifies.
class GlObject {
 public:
  using Deleter = void (*)(unsigned id);

  GlObject() = default;
  GlObject(unsigned id, Deleter deleter) : id_(id), deleter_(deleter) {}
  GlObject(GlObject&& other) noexcept { *this = std::move(other); }
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(deleter_, other.deleter_);
    return *this;
  }
  ~GlObject() {
    if (deleter_ != nullptr) deleter_(id_);
  }
  unsigned id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  unsigned id_ = 0;
  Deleter deleter_ = nullptr;
};

/// A buffer with `bytes` of storage that can be rewritten. `data` may be null.
GlObject MakeBuffer(std::size_t bytes, const void* data);
GlObject MakeVertexArray();
GlObject MakeQuery();

/// Converts a value in [0, 1] to a byte of a normalised format.
std::uint8_t Unorm8(double value);

enum class Filter { kNearest, kLinear, kMipmapped, kShadow };
enum class Wrap { kClamp, kRepeat };

/// A two-dimensional texture with immutable storage in an OpenGL sized format.
GlObject MakeTexture(unsigned format, int width, int height, Filter filter, Wrap wrap,
                     int levels = 1);
/// A framebuffer with the given colour textures. A non-zero `depth` is a depth, depth-stencil or
/// stencil texture. Throws InternalError if the framebuffer is incomplete.
GlObject MakeFramebuffer(const std::vector<unsigned>& colour, unsigned depth,
                         bool with_stencil = false);

/// Macros that are defined for the shaders' `#ifdef` lines.
using Switches = std::vector<std::string>;

/// A linked program of a vertex and a fragment shader from files in shaders/.
///
/// A line `#include "file.glsl"` includes another file of that folder. Switches remove code at
/// compile time, because software renderers pay for a branch on a uniform even if they do not take
/// it. Throws InputError with the driver's log if a file is absent or does not compile.
class Program {
 public:
  Program(const std::string& vertex_file, const std::string& fragment_file,
          const Switches& switches = {});

  void Use() const;
  // Ignores uniforms that the compiler has removed.
  void Set(const char* name, int value) const;
  void Set(const char* name, float value) const;
  void Set(const char* name, const Eigen::Vector2f& value) const;
  void Set(const char* name, const Eigen::Vector3f& value) const;
  void Set(const char* name, const Eigen::Vector4f& value) const;
  void Set(const char* name, const Eigen::Matrix3f& value) const;
  void Set(const char* name, const Eigen::Matrix4f& value) const;
  void Set(const char* name, const std::vector<Eigen::Vector3f>& values) const;
  unsigned id() const { return program_.id(); }

 private:
  int Location(const char* name) const;
  GlObject program_;
  mutable std::map<std::string, int, std::less<>> locations_;  ///< cache of uniform locations
};

}  // namespace tera
