#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>

#include "core/error.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/log_time.h"
#include "dataset/import/logs/nmea_sentence.h"
#include "dataset/import/logs/nmea_talkers.h"
#include "dataset/import/logs/number_table.h"

namespace tera {
namespace {

constexpr double kKnot_mps = 1852.0 / 3600;
constexpr TimeNs kDay_ns = 86'400 * kNsPerSecond;

/// Data of all sentences with the same time.
struct Epoch {
  int line = 0;
  TimeNs time_of_day_ns = 0;
  std::optional<TimeNs> date_ns = std::nullopt;
  std::string_view position = {};  ///< kind of the sentence that gave the position
  std::vector<NumberTable::Cell> values = {};

  /// A repeated value replaces the earlier one.
  void Put(std::string_view column, std::optional<double> value) {
    if (!value) return;
    for (NumberTable::Cell& cell : values) {
      if (cell.column != column) continue;
      cell.value = *value;
      return;
    }
    values.push_back({column, *value});
  }
};

using Fields = std::vector<std::string_view>;

std::string_view FieldAt(const Fields& fields, std::size_t k) {
  return k < fields.size() ? fields[k] : std::string_view();
}

/// Parses "123456.789" (hhmmss).
std::optional<TimeNs> TimeOf(std::string_view text) {
  if (text.size() < 6) return std::nullopt;
  return TimeOfDayText(std::string(text.substr(0, 2)) + ":" + std::string(text.substr(2, 2)) + ":" +
                       std::string(text.substr(4)));
}

/// Parses "010526" (ddmmyy), which is 1 May 2026. Years from 80 on are in the 20th century.
std::optional<TimeNs> DateOf(std::string_view text) {
  if (text.size() != 6) return std::nullopt;
  const auto day = WholeNumber(text.substr(0, 2)), month = WholeNumber(text.substr(2, 2)),
             year = WholeNumber(text.substr(4, 2));
  if (!day || !month || !year) return std::nullopt;
  return DayOf(static_cast<int>(*year) + (*year >= 80 ? 1900 : 2000), static_cast<int>(*month),
               static_cast<int>(*day));
}

/// Year, month or day with up to four digits; nullopt otherwise.
std::optional<int> NumberOfDate(std::string_view text) {
  const auto number = WholeNumber(text);
  if (!number || *number < 0 || *number > 9999) return std::nullopt;
  return static_cast<int>(*number);
}

/// Angle in degrees from ddmm.mm and hemisphere. The degrees have `digits` digits: "4646.8000000"
/// and 'N' have two.
std::optional<double> AngleOf(std::string_view text, std::string_view side, std::size_t digits) {
  if (text.size() < digits + 2 || side.size() != 1) return std::nullopt;
  const auto degrees = WholeNumber(text.substr(0, digits));
  const auto minutes = WholeNumber(text.substr(digits));
  if (!degrees || !minutes || *minutes < 0 || *minutes >= 60) return std::nullopt;
  const double angle_deg = *degrees + *minutes / 60;
  return side == "S" || side == "W" ? -angle_deg : angle_deg;
}

/// Best quality among the satellite systems, which have one letter each, such as "RRN".
std::optional<double> QualityOfModes(std::string_view modes) {
  constexpr std::array<std::pair<char, double>, 9> kModes = {
      {{'R', 4}, {'F', 5}, {'P', 2}, {'D', 2}, {'A', 1}, {'E', 6}, {'M', 7}, {'S', 8}, {'N', 0}}};
  for (const auto& [mode, quality] : kModes) {
    if (modes.find(mode) != std::string_view::npos) return quality;
  }
  return std::nullopt;
}

/// GGA quality for each GGK quality: none, single, RTK float, RTK fixed, differential, SBAS,
/// network RTK float and fixed in 3D and in 2D, OmniSTAR HP, VBS, Location RTK, beacon, RTX, xFill.
std::optional<double> QualityOfGgk(std::string_view text) {
  constexpr std::array<double, 16> kQuality = {0, 1, 5, 4, 2, 2, 5, 4, 5, 4, 5, 2, 5, 2, 5, 4};
  const auto told = WholeNumber(text);
  if (!told || *told < 0 || *told >= kQuality.size()) return std::nullopt;
  return kQuality[static_cast<std::size_t>(*told)];
}

class NmeaReader {
 public:
  /// An empty `talker` selects all talkers.
  NmeaReader(const std::filesystem::path& file, std::string talker, LeftOutRows* left_out)
      : lines_(file, BinaryFrameBytes), talker_(std::move(talker)), left_out_(left_out) {}

  std::vector<Epoch> Read() {
    for (std::string line; lines_.Next(&line);) {
      if (line.empty() || line.front() == '#' || line.front() == '!') continue;
      const auto sentence = SentenceIn(line);
      if (!sentence) {
        if (!first_unsound_) lines_.Fault("is not a sentence, which begins with '$'", left_out_);
      } else if (++sentences_; !sentence->is_sound) {
        TakeUnsound();
      } else if (first_unsound_) {
        throw InputError(*first_unsound_);
      } else if (!Take(FieldsOf(sentence->body, ','))) {
        lines_.Fault("is a sentence without its required fields", left_out_);
      }
    }
    if (unsound_ > 1 && unsound_ == sentences_) {
      throw InputError(
          lines_.file().string(),
          {FaultKind::kMalformed, fmt::format("all {} sentences have wrong checksums: did a "
                                              "program change them? need the receiver's own log",
                                              unsound_)});
    }
    if (first_unsound_) throw InputError(*first_unsound_);
    return std::move(epochs_);
  }

  const Talkers& talkers() const { return talkers_; }
  /// Number of sentences by kind, such as "10 GSV, 5 RMC".
  std::string KindsText() const {
    std::string text;
    for (const auto& [kind, count] : kinds_) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
    }
    return text;
  }

 private:
  /// A wrong checksum is reported only at the end: if all checksums are wrong, the message differs.
  void TakeUnsound() {
    ++unsound_;
    try {
      lines_.Fault("its checksum does not match the sentence", left_out_);
    } catch (const InputError& fault) {
      if (!first_unsound_) first_unsound_ = fault;
    }
  }

  /// The epoch of a time. A time that differs from the previous sentence starts a new epoch.
  Epoch& At(TimeNs time_of_day_ns) {
    if (epochs_.empty() || epochs_.back().time_of_day_ns != time_of_day_ns) {
      epochs_.push_back({.line = lines_.number(), .time_of_day_ns = time_of_day_ns});
      if (others_date_ && others_date_->first == time_of_day_ns) {
        epochs_.back().date_ns = others_date_->second;
      }
    }
    return epochs_.back();
  }

  /// Reads a sentence. Returns false for a malformed field. Other kinds of sentences are skipped.
  bool Take(Fields f) {
    std::string_view talker = f.front().substr(0, 2), kind = f.front();
    kind.remove_prefix(std::min<std::size_t>(kind.size(), 2));
    if (f.front().starts_with('P') && f.front().size() == 4) {
      // In a proprietary sentence, the kind is in the next field.
      talker = f.front();
      kind = FieldAt(f, 1);
      f.erase(f.begin());
    }
    ++kinds_[talker.size() == 2 ? std::string(kind) : fmt::format("{},{}", talker, kind)];
    const bool is_other = !talker_.empty() && talker != talker_;
    if (kind == "GGA") return TakePosition("GGA", talker, GgaOf(f));
    if (kind == "GNS") return TakePosition("GNS", talker, GnsOf(f));
    if (kind == "GGK") {
      return TakePosition("GGK", talker, GgkOf(f)) && TakeGgkDate(f, is_other);
    }
    if (is_other) {
      // The date is valid for all receivers.
      const auto time_ns = TimeOf(FieldAt(f, 1)), date_ns = DateOf(FieldAt(f, 9));
      if (kind == "RMC" && time_ns && date_ns) others_date_ = {*time_ns, *date_ns};
      return true;
    }
    if (kind == "RMC") return TakeRmc(f);
    if (kind == "GST") return TakeGst(f);
    if (kind == "ZDA") return TakeZda(f);
    if (epochs_.empty()) return true;
    if (kind == "HDT") epochs_.back().Put("heading", WholeNumber(FieldAt(f, 1)));
    if (kind == "VTG") {
      const auto knots = WholeNumber(FieldAt(f, 5));
      epochs_.back().Put("course", WholeNumber(FieldAt(f, 1)));
      if (knots) epochs_.back().Put("speed", *knots * kKnot_mps);
    }
    return true;
  }

  static std::optional<NmeaPosition> GgaOf(const Fields& f) {
    return PositionOf(f, WholeNumber(FieldAt(f, 6)), 11);
  }
  static std::optional<NmeaPosition> GnsOf(const Fields& f) {
    return PositionOf(f, QualityOfModes(FieldAt(f, 6)), 10);
  }
  /// Position in a GGA or GNS sentence. They differ in the quality and in the field of the geoid
  /// separation.
  static std::optional<NmeaPosition> PositionOf(const Fields& f, std::optional<double> quality,
                                                std::size_t separation_at) {
    const auto time_ns = TimeOf(FieldAt(f, 1));
    if (!time_ns || !quality) return std::nullopt;
    NmeaPosition position{.time_of_day_ns = *time_ns,
                          .quality = *quality,
                          .lat_deg = AngleOf(FieldAt(f, 2), FieldAt(f, 3), 2),
                          .lon_deg = AngleOf(FieldAt(f, 4), FieldAt(f, 5), 3),
                          .msl_m = WholeNumber(FieldAt(f, 9)),
                          .satellites = WholeNumber(FieldAt(f, 7)),
                          .hdop = WholeNumber(FieldAt(f, 8))};
    const auto separation_m = WholeNumber(FieldAt(f, separation_at));
    if (position.msl_m && separation_m) position.altitude_m = *position.msl_m + *separation_m;
    return position;
  }
  /// The first letters of the height tell whether it is above the ellipsoid or the sea.
  static std::optional<NmeaPosition> GgkOf(const Fields& f) {
    const auto time_ns = TimeOf(FieldAt(f, 1));
    const auto quality = QualityOfGgk(FieldAt(f, 7));
    if (!time_ns || !quality) return std::nullopt;
    NmeaPosition position{.time_of_day_ns = *time_ns,
                          .quality = *quality,
                          .lat_deg = AngleOf(FieldAt(f, 3), FieldAt(f, 4), 2),
                          .lon_deg = AngleOf(FieldAt(f, 5), FieldAt(f, 6), 3),
                          .satellites = WholeNumber(FieldAt(f, 8)),
                          .hdop = WholeNumber(FieldAt(f, 9))};
    const std::string_view height = FieldAt(f, 10);
    if (height.starts_with("EHT")) position.altitude_m = WholeNumber(height.substr(3));
    if (height.starts_with("GHT")) position.msl_m = WholeNumber(height.substr(3));
    return position;
  }
  /// Date in a GGK sentence. The date of another receiver is used too.
  bool TakeGgkDate(const Fields& f, bool is_other) {
    if (!is_other && !is_taken_) return true;
    const std::string date(FieldAt(f, 2));
    const auto time_ns = TimeOf(FieldAt(f, 1));
    if (date.empty()) return true;
    if (date.size() != 6) return false;
    const auto date_ns = DateOf(date.substr(2, 2) + date.substr(0, 2) + date.substr(4));
    if (date_ns && is_other) others_date_ = {*time_ns, *date_ns};
    if (date_ns && !is_other) At(*time_ns).date_ns = date_ns;
    return date_ns.has_value();
  }

  bool TakePosition(std::string_view kind, std::string_view talker,
                    const std::optional<NmeaPosition>& position) {
    is_taken_ = false;
    if (!position || !position->IsWhole()) return false;
    const bool agrees = talkers_.Add(kind, talker, *position);
    if (!talker_.empty() && talker != talker_) return true;
    if (!agrees) {
      lines_.Fault(fmt::format("gives another position than an earlier {} of the same time and "
                               "talker: are there two receivers? write each into its own file",
                               kind),
                   left_out_);
      return true;
    }
    is_taken_ = true;
    Epoch& epoch = At(position->time_of_day_ns);
    if (!epoch.position.empty() && epoch.position != kind) return true;
    epoch.position = kind;
    epoch.Put("fix", position->quality);
    epoch.Put("satellites", position->satellites);
    epoch.Put("hdop", position->hdop);
    if (position->quality == 0) return true;
    epoch.Put("latitude", position->lat_deg);
    epoch.Put("longitude", position->lon_deg);
    epoch.Put("msl", position->msl_m);
    epoch.Put("altitude", position->altitude_m);
    return true;
  }

  bool TakeRmc(const Fields& f) {
    const auto time_ns = TimeOf(FieldAt(f, 1)), date_ns = DateOf(FieldAt(f, 9));
    if (!time_ns || (!date_ns && !FieldAt(f, 9).empty())) return false;
    Epoch& epoch = At(*time_ns);
    if (date_ns) epoch.date_ns = date_ns;
    const auto knots = WholeNumber(FieldAt(f, 7));
    if (knots) epoch.Put("speed", *knots * kKnot_mps);
    epoch.Put("course", WholeNumber(FieldAt(f, 8)));
    return true;
  }

  bool TakeGst(const Fields& f) {
    const auto time_ns = TimeOf(FieldAt(f, 1));
    if (!time_ns) return false;
    Epoch& epoch = At(*time_ns);
    constexpr std::pair<std::size_t, std::pair<const char*, const char*>> kPlaces[] = {
        {6, {"sdn", "var_n"}}, {7, {"sde", "var_e"}}, {8, {"sdu", "var_u"}}};
    for (const auto& [place, names] : kPlaces) {
      const auto sigma_m = WholeNumber(FieldAt(f, place));
      if (!sigma_m) continue;
      epoch.Put(names.first, *sigma_m);
      epoch.Put(names.second, *sigma_m * *sigma_m);
    }
    return true;
  }

  bool TakeZda(const Fields& f) {
    const auto time_ns = TimeOf(FieldAt(f, 1));
    const auto day = NumberOfDate(FieldAt(f, 2)), month = NumberOfDate(FieldAt(f, 3)),
               year = NumberOfDate(FieldAt(f, 4));
    if (!time_ns || !day || !month || !year) return false;
    const auto date_ns = DayOf(*year, *month, *day);
    if (!date_ns) return false;
    At(*time_ns).date_ns = date_ns;
    return true;
  }

  LogLines lines_;
  std::string talker_;
  LeftOutRows* left_out_;
  std::vector<Epoch> epochs_;
  Talkers talkers_;
  std::map<std::string, int> kinds_;
  bool is_taken_ = false;  ///< the last position is from the selected talker and consistent
  int sentences_ = 0, unsound_ = 0;
  std::optional<InputError> first_unsound_;
  std::optional<std::pair<TimeNs, TimeNs>>
      others_date_;  ///< time of day and date from another receiver
};

/// Assigns dates to all epochs, starting from those with a known date. A time of day that goes back
/// by more than half a day is on the next day.
void FillDates(std::vector<Epoch>* epochs) {
  const auto known = std::find_if(epochs->begin(), epochs->end(),
                                  [](const Epoch& e) { return e.date_ns.has_value(); });
  if (epochs->empty()) return;
  const auto start = known != epochs->end() ? known : epochs->begin();
  if (!start->date_ns) start->date_ns = 0;
  for (auto e = start; e != epochs->begin(); --e) {
    const bool over_midnight = (e - 1)->time_of_day_ns - e->time_of_day_ns > kDay_ns / 2;
    (e - 1)->date_ns = *e->date_ns - (over_midnight ? kDay_ns : 0);
  }
  for (auto e = start; e + 1 != epochs->end(); ++e) {
    const bool over_midnight = e->time_of_day_ns - (e + 1)->time_of_day_ns > kDay_ns / 2;
    if (!(e + 1)->date_ns) (e + 1)->date_ns = *e->date_ns + (over_midnight ? kDay_ns : 0);
  }
}

}  // namespace

NmeaContents ContentsOfNmea(const std::filesystem::path& file) {
  LeftOutRows left_out;
  NmeaReader reader(file, "", &left_out);
  const std::vector<Epoch> epochs = reader.Read();
  return {.rivals = reader.talkers().Rivals(),
          .kinds = reader.KindsText(),
          .has_dates = std::any_of(epochs.begin(), epochs.end(),
                                   [](const Epoch& e) { return e.date_ns.has_value(); })};
}

std::unique_ptr<const RowTable> ReadNmeaLog(const std::filesystem::path& file,
                                            const std::string& talker, LeftOutRows* left_out) {
  auto table = std::make_unique<NumberTable>(
      file, std::vector<std::string>{"latitude", "longitude", "altitude", "msl", "fix",
                                     "satellites", "hdop", "speed", "course", "heading", "sdn",
                                     "sde", "sdu", "var_n", "var_e", "var_u"});
  NmeaReader reader(file, talker, left_out);
  std::vector<Epoch> epochs = reader.Read();
  const std::vector<std::string> rivals = reader.talkers().Rivals(), all = reader.talkers().All();
  if (talker.empty() && !rivals.empty()) {
    throw InputError(
        file.string(),
        {FaultKind::kMissing,
         fmt::format("the talkers {} give positions at the same times: are there several "
                     "receivers? choose one, for instance 'talker: {}' beside the file",
                     fmt::join(rivals, ", "), rivals.front())});
  }
  if (!talker.empty() && std::find(all.begin(), all.end(), talker) == all.end()) {
    throw InputError(file.string(),
                     {FaultKind::kNoSuchName,
                      fmt::format("no position has the talker '{}'; the log has {}", talker,
                                  all.empty() ? "none" : fmt::format("{}", fmt::join(all, ", ")))});
  }
  FillDates(&epochs);
  for (const Epoch& epoch : epochs) {
    table->AddRow(epoch.line, *epoch.date_ns + epoch.time_of_day_ns, epoch.values);
  }
  return table;
}

}  // namespace tera
