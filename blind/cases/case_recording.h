#pragma once

#include <map>
#include <string>
#include <vector>

namespace tera::blind {

/// The machine's in scenario and recording.
inline constexpr const char* kName = "digger";

/// Columns over time, as a CSV file of the recording has them.
struct Table {
  std::vector<std::string> columns;  ///< without t_ns
  std::vector<long long> t_ns;
  std::vector<std::vector<double>> rows;
};

/// What a hidden effect changes in a channel, over the deviation of its noise.
struct Change {
  std::vector<double> t_s, over_noise;
  double Rms() const;
  /// How long it changes the channel by more than the noise's deviation.
  double Shows_s() const;
};

/// A case as it was driven and measured.
struct CaseRecording {
  Table commands, encoders, poses;  ///< poses without columns: none
  std::vector<Change> changes;      ///< for each of what is hidden, the others being there
  /// RMS of what measuring adds, by the names that the tool has for its channels.
  std::map<std::string, double> noise_rms;
};

}  // namespace tera::blind
