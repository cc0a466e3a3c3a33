#pragma once

#include <map>
#include <string>
#include <vector>

namespace tera::blind {

/// Name of the machine in scenario and recording.
inline constexpr const char* kName = "digger";

/// Columns over time, as in a CSV file of the recording.
struct Table {
  std::vector<std::string> columns;  ///< without t_ns
  std::vector<long long> t_ns;
  std::vector<std::vector<double>> rows;
};

/// Change of a channel by a hidden effect, over the standard deviation of its noise.
struct Change {
  std::vector<double> t_s, over_noise;
  double Rms() const;
  /// Duration for which the change exceeds the noise's deviation.
  double Shows_s() const;
};

/// Recording of a case.
struct CaseRecording {
  Table commands, encoders, poses;  ///< poses without columns: none
  std::vector<Change> changes;      ///< one for each hidden effect, with the others present
  /// RMS of the measurement noise, by the tool's names of its channels.
  std::map<std::string, double> noise_rms;
};

}  // namespace tera::blind
