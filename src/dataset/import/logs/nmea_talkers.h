#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

/// Receivers that write into one log of NMEA 0183.

namespace tera {

/// Where a sentence says that its receiver is.
struct NmeaPosition {
  TimeNs time_of_day_ns = 0;
  double quality = 0;  ///< of GGA
  std::optional<double> lat_deg, lon_deg, msl_m = std::nullopt, altitude_m = std::nullopt;
  std::optional<double> satellites, hdop;

  bool IsWhole() const { return quality == 0 || (lat_deg && lon_deg && (msl_m || altitude_m)); }
};

/// Sentences of one kind say of one time and talker the same; those of several talkers, that there
/// are several receivers.
class Talkers {
 public:
  /// Counts a position. False where the same talker says another place of the same time.
  bool Add(std::string_view kind, std::string_view talker, const NmeaPosition& position);
  /// Those that say of the same times where they are, the one with most positions first.
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
