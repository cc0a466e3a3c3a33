#include "render/gl/passes/full_screen.h"

#include <epoxy/gl.h>

namespace tera {

void FullScreen::Draw() const {
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SetView(const View& view, const Program& program) {
  // The ray of window position p is (x, y, 1) with (x, y) = (p - 1/2 - c) / f.
  program.Set("u_pixel_to_ray", Eigen::Vector4f(Eigen::Vector4d(-(view.cx_px + 0.5) / view.fx_px,
                                                                -(view.cy_px + 0.5) / view.fy_px,
                                                                1 / view.fx_px, 1 / view.fy_px)
                                                    .cast<float>()));
  program.Set("u_R_WC", Eigen::Matrix3f(view.R_WC.cast<float>()));
  program.Set("u_eye_W", Eigen::Vector3f(view.eye_W_m.cast<float>()));
  program.Set("u_near_m", static_cast<float>(view.near_m));
}

}  // namespace tera
