#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/log_time.h"
#include "dataset/import/logs/number_table.h"

namespace tera {
namespace {

constexpr double kKnot_mps = 1852.0 / 3600;
constexpr TimeNs kDay_ns = 86'400 * kNsPerSecond;

/// What sentences say of one time.
struct Epoch {
  int line = 0;
  TimeNs time_of_day_ns = 0;
  std::optional<TimeNs> date_ns;
  std::vector<NumberTable::Cell> values;

  /// What is said again is what counts.
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

/// "123456.789".
std::optional<TimeNs> TimeOf(std::string_view text) {
  if (text.size() < 6) return std::nullopt;
  return TimeOfDayText(std::string(text.substr(0, 2)) + ":" + std::string(text.substr(2, 2)) + ":" +
                       std::string(text.substr(4)));
}

/// "010526" is the first of May of 2026: years from 80 on are of the century before.
std::optional<TimeNs> DateOf(std::string_view text) {
  if (text.size() != 6) return std::nullopt;
  const auto day = WholeNumber(text.substr(0, 2)), month = WholeNumber(text.substr(2, 2)),
             year = WholeNumber(text.substr(4, 2));
  if (!day || !month || !year) return std::nullopt;
  return DayOf(static_cast<int>(*year) + (*year >= 80 ? 1900 : 2000), static_cast<int>(*month),
               static_cast<int>(*day));
}

/// A year, month or day: whatever is no number of up to four digits is none.
std::optional<int> NumberOfDate(std::string_view text) {
  const auto number = WholeNumber(text);
  if (!number || *number < 0 || *number > 9999) return std::nullopt;
  return static_cast<int>(*number);
}

/// Degrees of "4646.8000000" and 'N', or of three digits of degrees and 'W'.
std::optional<double> AngleOf(std::string_view text, std::string_view side, std::size_t digits) {
  if (text.size() < digits + 2 || side.size() != 1) return std::nullopt;
  const auto degrees = WholeNumber(text.substr(0, digits));
  const auto minutes = WholeNumber(text.substr(digits));
  if (!degrees || !minutes || *minutes < 0 || *minutes >= 60) return std::nullopt;
  const double angle_deg = *degrees + *minutes / 60;
  return side == "S" || side == "W" ? -angle_deg : angle_deg;
}

/// Whether a sentence's checksum is its own, or missing; its body is then `body`.
bool IsSound(std::string_view line, std::string_view* body) {
  const std::size_t star = line.rfind('*');
  *body = line.substr(1, star == std::string_view::npos ? star : star - 1);
  if (star == std::string_view::npos) return true;
  unsigned sum = 0;
  for (const char c : *body) sum ^= static_cast<unsigned char>(c);
  std::string told(line.substr(star + 1));
  std::transform(told.begin(), told.end(), told.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return told == fmt::format("{:02X}", sum);
}

class NmeaReader {
 public:
  NmeaReader(const std::filesystem::path& file, LeftOutRows* left_out)
      : lines_(file), left_out_(left_out) {}

  std::vector<Epoch> Read() {
    for (std::string line; lines_.Next(&line);) {
      if (line.empty() || line.front() == '#' || line.front() == '!') continue;
      std::string_view body;
      if (line.front() != '$') {
        lines_.Fault("is no sentence, which begins with '$'", left_out_);
      } else if (!IsSound(line, &body)) {
        lines_.Fault("its checksum is not that of the sentence", left_out_);
      } else if (!Take(FieldsOf(body, ','))) {
        lines_.Fault("is a sentence without the fields that it must have", left_out_);
      }
    }
    return std::move(epochs_);
  }

 private:
  /// The epoch of a time; a new one where it is another than that of the sentence before.
  Epoch& At(TimeNs time_of_day_ns) {
    if (epochs_.empty() || epochs_.back().time_of_day_ns != time_of_day_ns) {
      epochs_.push_back({.line = lines_.number(), .time_of_day_ns = time_of_day_ns});
    }
    return epochs_.back();
  }

  /// False where a field is not as it must be. Sentences of other kinds are passed over.
  bool Take(const Fields& f) {
    const std::string_view head = f.front();
    const std::string_view kind = head.size() == 5 ? head.substr(2) : "";
    if (kind == "GGA") return TakeGga(f);
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

  bool TakeGga(const Fields& f) {
    const auto time_ns = TimeOf(FieldAt(f, 1));
    const auto quality = WholeNumber(FieldAt(f, 6));
    if (!time_ns || !quality) return false;
    return TakeFix(f, *time_ns, *quality);
  }

  bool TakeFix(const Fields& f, TimeNs time_ns, double quality) {
    const auto lat = AngleOf(FieldAt(f, 2), FieldAt(f, 3), 2);
    const auto lon = AngleOf(FieldAt(f, 4), FieldAt(f, 5), 3);
    const auto msl = WholeNumber(FieldAt(f, 9)), separation = WholeNumber(FieldAt(f, 11));
    if (quality != 0 && (!lat || !lon || !msl)) return false;
    Epoch& epoch = At(time_ns);
    epoch.Put("fix", quality);
    epoch.Put("satellites", WholeNumber(FieldAt(f, 7)));
    epoch.Put("hdop", WholeNumber(FieldAt(f, 8)));
    if (quality == 0) return true;
    epoch.Put("latitude", *lat);
    epoch.Put("longitude", *lon);
    epoch.Put("msl", *msl);
    epoch.Put("altitude", separation ? std::optional(*msl + *separation) : std::nullopt);
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
  LeftOutRows* left_out_;
  std::vector<Epoch> epochs_;
};

/// Dates of all, from those that say theirs: a time of day that goes back by more than half a day
/// is of the next one.
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

std::unique_ptr<const RowTable> ReadNmeaLog(const std::filesystem::path& file,
                                            LeftOutRows* left_out) {
  auto table = std::make_unique<NumberTable>(
      file, std::vector<std::string>{"latitude", "longitude", "altitude", "msl", "fix",
                                     "satellites", "hdop", "speed", "course", "heading", "sdn",
                                     "sde", "sdu", "var_n", "var_e", "var_u"});
  std::vector<Epoch> epochs = NmeaReader(file, left_out).Read();
  FillDates(&epochs);
  for (const Epoch& epoch : epochs) {
    table->AddRow(epoch.line, *epoch.date_ns + epoch.time_of_day_ns, epoch.values);
  }
  return table;
}

}  // namespace tera
