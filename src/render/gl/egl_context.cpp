#include "render/gl/egl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cstring>
#include <mutex>
#include <vector>

#include "core/check.h"
#include "core/config/spelling.h"
#include "core/error.h"

namespace tera {
namespace {

constexpr int kMaxDevices = 32;

bool HasExtension(const char* list, const char* name) {
  return list != nullptr && epoxy_extension_in_string(list, name);
}

struct Candidate {
  std::string platform;
  EGLDisplay display = EGL_NO_DISPLAY;
};

std::vector<EGLDeviceEXT> Devices() {
  // EGL_EXT_device_base combines enumeration and query. Some drivers list only that older
  // extension.
  const char* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!HasExtension(extensions, "EGL_EXT_device_enumeration") &&
      !HasExtension(extensions, "EGL_EXT_device_base")) {
    return {};
  }
  std::vector<EGLDeviceEXT> devices(kMaxDevices);
  EGLint count = 0;
  if (!eglQueryDevicesEXT(kMaxDevices, devices.data(), &count)) count = 0;
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

bool IsSoftware(EGLDeviceEXT device) {
  return HasExtension(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

Candidate DeviceDisplay(EGLDeviceEXT device, int index) {
  return {fmt::format("device {}", index),
          eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr)};
}

/// Displays to try, best first.
std::vector<Candidate> Candidates(int wanted_device) {
  const std::vector<EGLDeviceEXT> devices = Devices();
  const int count = static_cast<int>(devices.size());
  if (wanted_device >= count) {
    throw InputError(
        "", {FaultKind::kUnsupported, fmt::format("EGL device {} asked for, but there are {} EGL "
                                                  "devices; give an index below that, or none "
                                                  "to let TERA choose",
                                                  wanted_device, count)});
  }
  if (wanted_device >= 0) return {DeviceDisplay(devices[wanted_device], wanted_device)};
  std::vector<Candidate> candidates;
  for (int i = 0; i < count; ++i) {
    if (!IsSoftware(devices[i])) candidates.push_back(DeviceDisplay(devices[i], i));
  }
  if (HasExtension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS),
                   "EGL_MESA_platform_surfaceless")) {
    candidates.push_back({"surfaceless", eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                                  EGL_DEFAULT_DISPLAY, nullptr)});
  }
  return candidates;
}

/// Mutex of software contexts. It is held while such a context is current, created or destroyed.
std::mutex& Turn() {
  static std::mutex turn;
  return turn;
}

EGLContext CreateContext(EGLDisplay display) {
  const std::lock_guard lock(Turn());
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return EGL_NO_CONTEXT;
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
}

std::string GlText(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

/// Recognises Mesa's software renderers in GL_RENDERER, also below layered drivers: "zink Vulkan
/// 1.3(llvmpipe ...)", "virgl (LLVMPIPE ...)".
bool DrawsInSoftware(const std::string& renderer) {
  const std::string name = LowerCase(renderer);
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

}  // namespace

EglContext::EglContext(const EglOptions& options) {
  std::string tried;
  for (const Candidate& candidate : Candidates(options.device)) {
    const EGLContext context = CreateContext(candidate.display);
    if (context != EGL_NO_CONTEXT) {
      display_ = candidate.display;
      context_ = context;
      info_.egl_platform = candidate.platform;
      break;
    }
    tried += (tried.empty() ? "" : ", ") + candidate.platform;
  }
  if (context_ == nullptr) {
    throw InputError(
        "", {FaultKind::kUnsupported,
             fmt::format(
                 "no EGL platform gives an OpenGL 4.5 core context (tried: {}); install Mesa's "
                 "software "
                 "renderer (Debian: libegl1 libegl-mesa0 libgl1-mesa-dri) or a GPU driver with EGL",
                 tried.empty() ? "none available" : tried)});
  }
  info_.is_software = true;  // assumed until the renderer's name is known
  const Current current(*this);
  info_.vendor = GlText(GL_VENDOR);
  info_.renderer = GlText(GL_RENDERER);
  info_.version = GlText(GL_VERSION);
  info_.is_software = DrawsInSoftware(info_.renderer);
}

EglContext::~EglContext() {
  // The display is not terminated: other contexts of the process may use the same display.
  const std::lock_guard lock(Turn());
  eglDestroyContext(display_, context_);
}

EglContext::Current::Current(const EglContext& context)
    : display_(context.display_),
      context_(context.context_),
      takes_turns_(context.info_.is_software) {
  Take();
}

EglContext::Current::~Current() { Release(); }

void EglContext::Current::Take() {
  if (takes_turns_) Turn().lock();
  is_taken_ = true;
  eglBindAPI(EGL_OPENGL_API);
  const bool made = eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  TERA_CHECK(made, eglGetError());
}

void EglContext::Current::Release() {
  if (!is_taken_) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  is_taken_ = false;
  if (takes_turns_) Turn().unlock();
}

}  // namespace tera
