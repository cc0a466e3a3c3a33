#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "diagnose/replay/effort_log.h"
#include "sim/drive_fixture.h"

namespace tera {

/// Contents of a recording: ideal encoders and efforts.
struct RecordedEfforts {
  TableRecording efforts;
  std::vector<NamedEncoders> encoders{{"m/encoders", {}}};
};

/// A sled of 95.1 kg that alternates on a level rail, with its effort by Newton's law.
struct Sled {
  explicit Sled(double offset_n = 0, double more_back_nspm = 0, double noise_n = 0) {
    const Stream noise(5, "noise");
    recorded.encoders[0].recording.axes.push_back({"carriage", true});
    recorded.efforts.columns = {"carriage_n"};
    for (int k = 0; k < 10000; ++k) {
      const double t_s = 0.004 * k, w = 2.2, z = 3.7;
      const double q_m = 0.04 * std::sin(w * t_s) + 0.015 * std::sin(z * t_s + 0.3);
      const double v_mps = 0.04 * w * std::cos(w * t_s) + 0.015 * z * std::cos(z * t_s + 0.3);
      const double a_mps2 =
          -0.04 * w * w * std::sin(w * t_s) - 0.015 * z * z * std::sin(z * t_s + 0.3);
      const double viscous_nspm = v_mps > 0 ? 200 : 200 + more_back_nspm;
      const double force_n = 95.1 * a_mps2 + std::copysign(20, v_mps) + viscous_nspm * v_mps +
                             offset_n + noise_n * noise.Gaussian(static_cast<std::uint64_t>(k));
      const TimeNs t_ns = TimeNs{k} * 4'000'000;
      recorded.encoders[0].recording.samples.push_back(
          {.t_ns = t_ns, .q_rad = {q_m}, .qd_radps = {v_mps}});
      recorded.efforts.t_ns.push_back(t_ns);
      recorded.efforts.rows.push_back({force_n});
    }
    model = Drive::Read("emps.yaml", "{}", "soil: asphalt", "").machines[0].placement.model;
  }
  std::vector<EffortLog> Logs() const {
    return MakeEffortLogs(model, "m/efforts", recorded.efforts, recorded.encoders);
  }

  RecordedEfforts recorded;
  MachineModel model;
};

}  // namespace tera
