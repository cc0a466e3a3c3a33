#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/motion.h"

/// OpenGL objects that free themselves. All need a current context, also to be destroyed.

namespace tera {

/// Owner of one OpenGL name.
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

/// A buffer with `bytes` of storage that can be rewritten; `data` may be null.
GlObject MakeBuffer(std::size_t bytes, const void* data);
GlObject MakeVertexArray();
GlObject MakeQuery();

/// 0 to 1 as a byte of OpenGL's normalised formats.
std::uint8_t Unorm8(double value);

enum class Filter { kNearest, kLinear, kMipmapped, kShadow };
enum class Wrap { kClamp, kRepeat };

/// Immutable two-dimensional storage of an OpenGL sized format.
GlObject MakeTexture(unsigned format, int width, int height, Filter filter, Wrap wrap,
                     int levels = 1);
/// A framebuffer with colour attachments in order and, if not 0, a depth (or depth-stencil or
/// stencil) texture. Throws InternalError if it is incomplete.
GlObject MakeFramebuffer(const std::vector<unsigned>& colour, unsigned depth,
                         bool with_stencil = false);

/// Names that `#ifdef` lines of shaders ask for.
using Switches = std::vector<std::string>;

/// A linked vertex and fragment shader from files in shaders/.
///
/// A line `#include "file.glsl"` pulls in another file of that folder. A branch that a uniform
/// shuts still costs its time on a renderer that runs pixels in lockstep; what no switch names
/// costs none. Throws InputError with the driver's log if a file is missing or does not compile.
class Program {
 public:
  Program(const std::string& vertex_file, const std::string& fragment_file,
          const Switches& switches = {});

  void Use() const;
  // A uniform that the compiler removed is ignored.
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
  mutable std::map<std::string, int, std::less<>> locations_;  ///< of uniforms that were asked for
};

}  // namespace tera
