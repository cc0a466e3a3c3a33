#include "sensors/slots/row_slots.h"

#include "sensors/slots/report_clock.h"

namespace tera {

RowSlots::RowSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : ideal_(effects.empty()), filter_(effects), clock_(effects, seed, stream_name) {}

void RowSlots::Apply(RowSample* row) {
  if (ideal_) return;
  if (filter_.present()) {
    Eigen::Map<Eigen::VectorXd> x(row->values.data(),
                                  static_cast<Eigen::Index>(row->values.size()));
    x = Eigen::VectorXd(filter_.Next(row->t_ns, x));
  }
  Restamp(clock_.Next(next_++, row->t_ns), row);
}

}  // namespace tera
