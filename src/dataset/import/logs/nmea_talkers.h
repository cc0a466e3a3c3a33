#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

/// Receivers that write to one NMEA 0183 log.

namespace tera {

/// A receiver's position in a sentence.
struct NmeaPosition {
  TimeNs time_of_day_ns = 0;
  double quality = 0;  ///< GGA's quality
  std::optional<double> lat_deg, lon_deg, msl_m = std::nullopt, altitude_m = std::nullopt;
  std::optional<double> satellites, hdop;

  bool IsWhole() const { return quality == 0 || (lat_deg && lon_deg && (msl_m || altitude_m)); }
};

/// Detects several receivers in one log. Sentences of one kind, time and talker have one position;
/// different talkers at the same times are different receivers. Both are judged among the latest
/// sentences of a kind.
class Talkers {
 public:
  /// Counts a position. Returns false if the talker gives another position for the same time.
  bool Add(std::string_view kind, std::string_view talker, const NmeaPosition& position);
  /// Talkers with positions at the same times, the one with most positions first.
  std::vector<std::string> Rivals() const;
  std::vector<std::string> All() const;

 private:
  struct Said {
    std::string talker;
    NmeaPosition position;
  };
  std::map<std::string, std::deque<Said>> said_;  ///< by kind
  std::map<std::string, int> count_;
  std::map<std::string, bool> rival_;
};

}  // namespace tera
