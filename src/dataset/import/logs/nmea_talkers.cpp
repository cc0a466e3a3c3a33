#include "dataset/import/logs/nmea_talkers.h"

#include <algorithm>

namespace tera {

bool Talkers::Add(std::string_view kind, std::string_view talker, const NmeaPosition& position) {
  std::deque<Said>& said = said_[std::string(kind)];
  ++count_[std::string(talker)];
  const auto agrees = [&](const Said& s) {
    return s.position.time_of_day_ns != position.time_of_day_ns || s.talker != talker ||
           (s.position.lat_deg == position.lat_deg && s.position.lon_deg == position.lon_deg &&
            s.position.msl_m == position.msl_m);
  };
  const bool is_same = std::all_of(said.begin(), said.end(), agrees);
  for (const Said& s : said) {
    if (s.talker == talker || s.position.time_of_day_ns != position.time_of_day_ns) continue;
    rival_[s.talker] = rival_[std::string(talker)] = true;
  }
  constexpr std::size_t kRemembered =
      32;  // positions kept per kind; receivers in one log alternate more often than this
  said.push_back({std::string(talker), position});
  if (said.size() > kRemembered) said.pop_front();
  return is_same;
}

std::vector<std::string> Talkers::Rivals() const {
  std::vector<std::string> rivals;
  for (const auto& [talker, is_rival] : rival_) rivals.push_back(talker);
  std::stable_sort(rivals.begin(), rivals.end(), [&](const std::string& a, const std::string& b) {
    return count_.at(a) > count_.at(b);
  });
  return rivals;
}

std::vector<std::string> Talkers::All() const {
  std::vector<std::string> all;
  for (const auto& [talker, count] : count_) all.push_back(talker);
  return all;
}

}  // namespace tera
