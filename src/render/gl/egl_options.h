#pragma once

#include <string>

namespace tera {

/// Which OpenGL to ask for.
struct EglOptions {
  /// Index of an EGL device; -1 chooses: one with a GPU if there is one, else Mesa.
  int device = -1;
};

/// The OpenGL that was got.
struct GlInfo {
  std::string egl_platform;  ///< "device 0" or "surfaceless"
  std::string vendor, renderer, version;
  bool is_software = false;  ///< drawn by the processor
};

}  // namespace tera
