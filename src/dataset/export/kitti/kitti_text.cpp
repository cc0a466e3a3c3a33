#include "dataset/export/kitti/kitti_text.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "dataset/export/stamp_text.h"

namespace tera {

std::string NumbersText(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  std::string text;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      text += fmt::format("{}{:.12e}", text.empty() ? "" : " ", matrix(row, column));
    }
  }
  return text;
}

std::string PoseText(const Pose& pose) { return NumbersText(pose.matrix().topRows<3>()); }

Eigen::Matrix<double, 3, 4> ProjectionOf(const CameraLens& lens) {
  Eigen::Matrix<double, 3, 4> P;
  P << lens.fx_px, 0, lens.cx_px, 0, 0, lens.fy_px, lens.cy_px, 0, 0, 0, 1, 0;
  return P;
}

std::string DateAndTimeText(TimeNs unix_ns) {
  const CivilTime t = CivilTimeOf(unix_ns);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}.{:09}", t.year, t.month, t.day, t.hour,
                     t.minute, t.second, t.nanosecond);
}

std::string CalibrationTimeText(TimeNs unix_ns) {
  constexpr std::array<std::string_view, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                        "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const CivilTime t = CivilTimeOf(unix_ns);
  return fmt::format("{:02}-{}-{:04} {:02}:{:02}:{:02}", t.day,
                     kMonths[static_cast<std::size_t>(t.month - 1)], t.year, t.hour, t.minute,
                     t.second);
}

std::string DayText(TimeNs unix_ns) {
  const CivilTime t = CivilTimeOf(unix_ns);
  return fmt::format("{:04}_{:02}_{:02}", t.year, t.month, t.day);
}

}  // namespace tera
