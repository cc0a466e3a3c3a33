#include "blind/mujoco/sensors/bracket.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kGravity_mps2 = 9.8071;
constexpr double kYields_s = 0.03;

}  // namespace

Bracket::Bracket(const BracketForm& form, const Vec3& force_mps2)
    : form_(form), bent_rad_(form.bends_rad * force_mps2.z() / kGravity_mps2) {}

std::array<double, 6> Bracket::Felt(const std::array<double, 6>& of_link, double step_s) {
  if (form_.bends_rad == 0) return of_link;
  const double bends_radps = (form_.bends_rad * of_link[5] / kGravity_mps2 - bent_rad_) / kYields_s;
  bent_rad_ += step_s * bends_radps;
  const Vec3 axis = form_.about_x ? Vec3::UnitX() : Vec3::UnitY();
  const Mat3 R_SL = Eigen::AngleAxisd(-bent_rad_, axis).toRotationMatrix();
  const Vec3 w = R_SL * Vec3(of_link[0], of_link[1], of_link[2]) + bends_radps * axis;
  const Vec3 f = R_SL * Vec3(of_link[3], of_link[4], of_link[5]);
  return {w.x(), w.y(), w.z(), f.x(), f.y(), f.z()};
}

}  // namespace tera::blind::mujoco
