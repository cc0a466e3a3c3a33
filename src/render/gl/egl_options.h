#pragma once

#include <string>

namespace tera {

/// Selects the OpenGL device.
struct EglOptions {
  /// Index of an EGL device. -1: the first device with a GPU, otherwise Mesa in software.
  int device = -1;
};

/// Properties of the created OpenGL context.
struct GlInfo {
  std::string egl_platform;  ///< "device 0" or "surfaceless"
  std::string vendor, renderer, version;
  bool is_software = false;  ///< rendering on the CPU
};

}  // namespace tera
