#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

/// Distinguishes receivers that write to the same NMEA 0183 log.

namespace tera {

/// A position in a sentence.
struct NmeaPosition {
  TimeNs time_of_day_ns = 0;
  double quality = 0;  ///< GGA quality
  std::optional<double> lat_deg, lon_deg, msl_m = std::nullopt, altitude_m = std::nullopt;
  std::optional<double> satellites, hdop;

  bool IsWhole() const { return quality == 0 || (lat_deg && lon_deg && (msl_m || altitude_m)); }
};

/// Detects several receivers in one log. Two talkers that report positions at the same times are
/// two receivers. A receiver reports only one position per sentence kind, time and talker. Only the
/// latest sentences of each kind are compared.
class Talkers {
 public:
  /// Adds a position. Returns false if the talker has given a different position for the same time.
  bool Add(std::string_view kind, std::string_view talker, const NmeaPosition& position);
  /// Talkers that report positions at the same times, sorted by number of positions, most first.
  std::vector<std::string> Rivals() const;
  std::vector<std::string> All() const;

 private:
  struct Said {
    std::string talker;
    NmeaPosition position;
  };
  std::map<std::string, std::deque<Said>> said_;  ///< by sentence kind
  std::map<std::string, int> count_;
  std::map<std::string, bool> rival_;
};

}  // namespace tera
