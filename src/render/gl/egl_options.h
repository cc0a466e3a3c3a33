#pragma once

#include <string>

namespace tera {

/// Choice of the OpenGL platform.
struct EglOptions {
  /// Index of an EGL device; -1: the first device with a GPU, otherwise Mesa.
  int device = -1;
};

/// Properties of the obtained OpenGL context.
struct GlInfo {
  std::string egl_platform;  ///< "device 0" or "surfaceless"
  std::string vendor, renderer, version;
  bool is_software = false;  ///< rendering on the CPU
};

}  // namespace tera
