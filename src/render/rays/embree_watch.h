#pragma once

#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "core/error.h"
#include "render/rays/embree_objects.h"

namespace tera {

/// Keeps the first error that Embree reports in any thread; Check throws it. An exception thrown
/// from Embree's callback would unwind through Embree's own frames.
class EmbreeErrors {
 public:
  void Watch(RTCDevice device) { rtcSetDeviceErrorFunction(device, &EmbreeErrors::Keep, this); }
  void Check() const {
    const std::lock_guard lock(mutex_);
    if (!first_.empty()) throw InternalError(first_);
  }

 private:
  static void Keep(void* self, RTCError code, const char* text) {
    auto& errors = *static_cast<EmbreeErrors*>(self);
    const std::lock_guard lock(errors.mutex_);
    if (!errors.first_.empty()) return;
    errors.first_ = fmt::format("Embree error {}: {}", static_cast<int>(code), text);
  }

  mutable std::mutex mutex_;
  std::string first_;
};

/// Counts the memory that an Embree device holds. Must outlive the device.
class EmbreeMemory {
 public:
  void Watch(RTCDevice device) {
    rtcSetDeviceMemoryMonitorFunction(device, &EmbreeMemory::Count, this);
  }
  std::int64_t bytes() const { return bytes_; }

 private:
  static bool Count(void* self, ssize_t bytes, bool /*post*/) {
    static_cast<EmbreeMemory*>(self)->bytes_ += bytes;
    return true;
  }

  std::atomic<std::int64_t> bytes_ = 0;
};

}  // namespace tera
