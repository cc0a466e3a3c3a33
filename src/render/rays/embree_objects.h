#pragma once

#include <embree3/rtcore.h>

#include <utility>

namespace tera {

/// Owns one reference to an Embree object.
template <typename Handle, void (*Release)(Handle)>
class EmbreeObject {
 public:
  EmbreeObject() = default;
  explicit EmbreeObject(Handle handle) : handle_(handle) {}
  EmbreeObject(EmbreeObject&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  EmbreeObject& operator=(EmbreeObject&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~EmbreeObject() {
    if (handle_ != nullptr) Release(handle_);
  }
  Handle get() const { return handle_; }

 private:
  Handle handle_ = nullptr;
};

using EmbreeDevice = EmbreeObject<RTCDevice, rtcReleaseDevice>;
using EmbreeScene = EmbreeObject<RTCScene, rtcReleaseScene>;
using EmbreeGeometry = EmbreeObject<RTCGeometry, rtcReleaseGeometry>;

}  // namespace tera
