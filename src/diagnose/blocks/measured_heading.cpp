#include "diagnose/blocks/measured_heading.h"

namespace tera {

void LetHeadingErr(double tolerance_rad, ReplayBlock* base) {
  const Series& forward_mps = base->channels[0].measured;
  Eigen::MatrixXd& nominal = base->channels[1].nominal;
  nominal.conservativeResize(static_cast<Eigen::Index>(forward_mps.size()), nominal.cols() + 1);
  for (std::size_t k = 0; k < forward_mps.size(); ++k) {
    nominal(static_cast<Eigen::Index>(k), nominal.cols() - 1) =
        forward_mps.valid[k] ? -0.5 * tolerance_rad * forward_mps.value[k] : 0;
  }
}

}  // namespace tera
