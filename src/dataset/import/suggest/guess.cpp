#include "dataset/import/suggest/guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/config/spelling.h"
#include "core/quantile.h"
#include "core/units.h"
#include "dataset/format/dataset_description.h"

namespace tera {
namespace {

double LargestOf(const std::vector<const NumbersOfColumn*>& columns) {
  double largest = 0;
  for (const NumbersOfColumn* column : columns) largest = std::max(largest, column->LargestSize());
  return largest;
}

/// Texts in a name that may be a unit: the text in brackets, or else the text after each separator.
std::vector<std::string_view> UnitTextsOf(std::string_view name) {
  const std::size_t open = name.find_first_of("[("), close = name.find_last_of("])");
  if (open != std::string_view::npos && close != std::string_view::npos && close > open) {
    return {name.substr(open + 1, close - open - 1)};
  }
  std::vector<std::string_view> texts;
  for (std::size_t k = 1; k < name.size(); ++k) {
    const auto is = [&](std::size_t at, int (*test)(int)) {
      return test(static_cast<unsigned char>(name[at])) != 0;
    };
    const bool begins =
        !is(k - 1, std::isalnum) || (is(k - 1, std::islower) && is(k, std::isupper));
    if (begins) texts.push_back(name.substr(k));
  }
  return texts;
}

UnitGuess GuessOf(const WrittenUnit& written) { return {written.unit->name, written.scale, ""}; }

}  // namespace

double NumbersOfColumn::LargestSize() const {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

double NumbersOfColumn::MedianStep() const {
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) steps.push_back(values[k] - values[k - 1]);
  return steps.empty() ? 0 : Median(std::move(steps));
}

double NumbersOfColumn::Least() const {
  return values.empty() ? 0 : *std::min_element(values.begin(), values.end());
}

std::optional<UnitGuess> ToldUnit(const NumbersOfColumn& column, Dimension dimension) {
  if (const auto unit = UnitOfText(column.unit, dimension)) return GuessOf(*unit);
  for (const std::string_view text : UnitTextsOf(column.name)) {
    if (const auto unit = UnitOfText(text, dimension)) return GuessOf(*unit);
  }
  return std::nullopt;
}

UnitGuess GuessAnyUnit(const NumbersOfColumn& column) {
  if (const auto unit = UnitOfText(column.unit, Dimension::kAny)) return GuessOf(*unit);
  const bool has_brackets = column.name.find_first_of("[(") != std::string::npos;
  for (const std::string_view text : UnitTextsOf(column.name)) {
    const auto unit = UnitOfText(text, Dimension::kAny);
    if (!unit) continue;
    // Without brackets, short endings are not units: "p_min" is a minimum, "valve_in" an inlet, and
    // a single last letter belongs to the name.
    const bool is_plain = text.size() >= 2 && text != "in" && text != "mg" &&
                          unit->unit->dimension != Dimension::kTime;
    if (has_brackets || is_plain) return GuessOf(*unit);
  }
  const std::string size = fmt::format("up to {:.4g}", column.LargestSize());
  if (!column.unit.empty()) return {"1", 1.0, fmt::format("in {}, {}", column.unit, size)};
  return {"1", 1.0, "unit unknown, " + size};
}

UnitGuess GuessAccelerationUnit(const std::vector<const NumbersOfColumn*>& axes) {
  if (const auto unit = ToldUnit(*axes.front(), Dimension::kAcceleration)) return *unit;
  double squares = 0;
  for (const NumbersOfColumn* axis : axes)
    squares += axis->values.empty() ? 0 : std::pow(Median(axis->values), 2);
  const double length = std::sqrt(squares), least = 0.7, most = 1.3;
  const auto is_about = [&](double gravity) {
    return length > least * gravity && length < most * gravity;
  };
  if (is_about(kStandardGravity_mps2)) return {"m/s2", 1.0, ""};
  if (is_about(1.0)) return {"g", 1.0, ""};
  if (is_about(1e3)) return {"g", 1e-3, ""};
  constexpr double kLeastCounts = 100;  // raw counts for 1 g
  std::string doubt =
      fmt::format("the median vector is {:.4g} long, which is gravity in no unit", length);
  if (length > kLeastCounts) doubt += fmt::format("; counts of g / {:.4g}?", length);
  return {kUnknownUnit, 1.0, doubt};
}

UnitGuess GuessAngleUnit(const std::vector<const NumbersOfColumn*>& angles) {
  if (const auto unit = ToldUnit(*angles.front(), Dimension::kAngle)) return *unit;
  const double largest = LargestOf(angles);
  // A slewing joint may exceed a full turn, but not this much.
  if (largest > 8 * kPi) return {"deg", 1.0, ""};
  const std::string size = fmt::format("the largest is {:.4g}", largest);
  if (largest > 2 * kPi) return {"deg", 1.0, size};
  if (angles.size() > 1 || largest == 0) return {"rad", 1.0, size};
  return {kUnknownUnit, 1.0, size + ": rad, or deg of a joint that hardly moves"};
}

bool NamesCounts(std::string_view name) {
  const std::vector<std::string> words = WordsOfName(name);
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    constexpr std::array<std::string_view, 8> kCounts = {"raw",  "count", "counts", "adc",
                                                         "tick", "ticks", "lsb",    "inkremente"};
    return std::find(kCounts.begin(), kCounts.end(), word) != kCounts.end();
  });
}

std::string YamlWord(std::string_view text) {
  const bool is_plain =
      !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
      std::all_of(text.begin(), text.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
      });
  constexpr std::array<std::string_view, 8> kWords = {"y",    "n",     "yes", "no",
                                                      "true", "false", "on",  "null"};
  const bool is_word =
      std::find(kWords.begin(), kWords.end(), LowerCase(std::string(text))) != kWords.end();
  return is_plain && !is_word && LowerCase(std::string(text)) != "off"
             ? std::string(text)
             : YamlQuoted(std::string(text));
}

std::vector<std::string> WordsOfName(std::string_view name) {
  std::vector<std::string> words;
  bool goes_on = false;
  const std::string_view bare = name.substr(0, name.find_first_of("[("));
  for (std::size_t k = 0; k < bare.size(); ++k) {
    const auto c = static_cast<unsigned char>(bare[k]);
    // Bytes of non-ASCII letters have the highest bit set.
    const bool is_letter = std::isalpha(c) != 0 || c >= 0x80;
    const bool is_hump = is_letter && k > 0 && std::isupper(c) != 0 &&
                         std::islower(static_cast<unsigned char>(bare[k - 1])) != 0;
    if (is_letter && (!goes_on || is_hump)) words.emplace_back();
    if (is_letter) words.back() += static_cast<char>(std::tolower(c));
    goes_on = is_letter;
  }
  return words;
}

std::string StemOfName(std::string_view name) {
  std::string stem;
  for (const char c : name.substr(0, name.find_first_of("[("))) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || byte >= 0x80) stem += static_cast<char>(std::tolower(byte));
  }
  // A single letter is a unit only if it is separated, as in "alt_m" but not in "heading".
  const std::string_view bare = name.substr(0, name.find_first_of("[("));
  for (const std::string_view text : UnitTextsOf(bare)) {
    const bool is_plain = text.size() > 1 || text == "m" || text == "g";
    if (!is_plain || !UnitOfText(text, Dimension::kAny)) continue;
    return StemOfName(bare.substr(0, bare.size() - text.size()));
  }
  for (const std::string_view unit : {"degps", "radps", "mps2", "dps", "deg", "rad", "rpm"}) {
    if (stem.ends_with(unit) && stem.size() > unit.size()) {
      stem.resize(stem.size() - unit.size());
      break;
    }
  }
  return stem;
}

std::string JointOfWord(std::string_view word) {
  struct Meaning {
    std::string_view word;
    const char* joint;
  };
  for (const Meaning& meaning : {Meaning{"swing", "swing"},
                                 {"slew", "slew"},
                                 {"boom", "boom"},
                                 {"arm", "arm"},
                                 {"stick", "stick"},
                                 {"dipper", "dipper"},
                                 {"bucket", "bucket"},
                                 {"ausleger", "boom"},
                                 {"stiel", "arm"},
                                 {"löffel", "bucket"},
                                 {"loeffel", "bucket"},
                                 {"drehwerk", "slew"},
                                 {"schwenkwerk", "slew"},
                                 {"oberwagen", "slew"},
                                 {"flèche", "boom"},
                                 {"fleche", "boom"},
                                 {"balancier", "arm"},
                                 {"godet", "bucket"},
                                 {"tourelle", "slew"}}) {
    if (word == meaning.word) return meaning.joint;
  }
  return "";
}

std::string JointOfAngle(const NumbersOfColumn& column) {
  constexpr std::array<std::string_view, 11> kOfAngles = {"angle",   "pos",     "position", "joint",
                                                          "winkel",  "encoder", "deg",      "rad",
                                                          "degrees", "grad",    "gon"};
  std::vector<std::string> words = WordsOfName(column.name);
  std::erase_if(words, [&](const std::string& word) {
    return std::find(kOfAngles.begin(), kOfAngles.end(), word) != kOfAngles.end();
  });
  // Splits compounds such as "boomangle".
  std::string word = words.size() == 1 ? words.front() : "";
  for (const std::string_view ending : {"angle", "position", "pos"}) {
    if (word.ends_with(ending)) word.resize(word.size() - ending.size());
  }
  // A column with another unit is a stroke, a pressure or a voltage.
  const bool is_unit_of_angle = ToldUnit(column, Dimension::kAngle).has_value();
  const bool has_other_unit = !column.unit.empty() && column.unit != "-" && column.unit != "1";
  const bool is_other = !is_unit_of_angle && (has_other_unit || GuessAnyUnit(column).unit != "1");
  return is_other ? "" : JointOfWord(word);
}

std::string JointOfRate(const NumbersOfColumn& column) {
  constexpr std::array<std::string_view, 11> kRates = {"rate",    "velocity",
                                                       "vel",     "omega",
                                                       "angvel",  "geschwindigkeit",
                                                       "speed",   "drehrate",
                                                       "vitesse", "winkelgeschwindigkeit",
                                                       "dot"};
  constexpr std::array<std::string_view, 14> kOthers = {
      "angular", "joint", "angle", "deg",   "rad",      "s",    "per",
      "sec",     "degs",  "rads",  "radps", "measured", "meas", "actual"};
  const auto told = ToldUnit(column, Dimension::kRate);
  const bool has_other_unit = !column.unit.empty() && column.unit != "-" && column.unit != "1";
  if (!told && (has_other_unit || GuessAnyUnit(column).unit != "1")) return "";
  std::string joint;
  bool is_rate = false;
  for (const std::string& word : WordsOfName(column.name)) {
    // A speed without a unit may belong to a cylinder or track, or be a fraction of the maximum.
    if (word == "speed" && !told) return "";
    const auto is_in = [&](const auto& words) {
      return std::find(words.begin(), words.end(), word) != words.end();
    };
    if (is_in(kRates)) {
      is_rate = true;
    } else if (joint.empty() && !JointOfWord(word).empty()) {
      joint = JointOfWord(word);
    } else if (!is_in(kOthers) && !UnitOfText(word, Dimension::kRate)) {
      return "";
    }
  }
  return is_rate ? joint : "";
}

std::string PlainNameOf(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool fits = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (fits) name += c;
    if (!fits && !name.empty() && name.back() != '_') name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  return name.empty() ? "unnamed" : name;
}

std::string OriginYaml(double lat_deg, double lon_deg, double height_m, std::string_view which) {
  return fmt::format(
      "origin: {{lat_deg: {:.9f}, lon_deg: {:.9f}, height_m: {:.4f}}}   # guessed: {}\n", lat_deg,
      lon_deg, height_m, which);
}

void RuleGuesses::Add(const std::string& rule, const std::string& reason) {
  rules_ += (rules_.empty() ? "" : ", ") + rule;
  reasons_ += (reasons_.empty() ? "" : "; ") + reason;
}

std::string RuleGuesses::Yaml(std::string_view indent) const {
  if (rules_.empty()) return "";
  return fmt::format("{}valid_if: [{}]   # guessed: {}\n", indent, rules_, reasons_);
}

void TimeSteps::Add(TimeNs t_ns) {
  if (rows++ > 0 && t_ns <= last_ns_) ++(t_ns == last_ns_ ? repeated : back);
  last_ns_ = t_ns;
}

void AddStepRule(const TimeSteps& steps, const std::string& column, RuleGuesses* rules) {
  if (steps.repeated == 0) return;
  rules->Add(fmt::format("{{column: {}, changes: true}}", column),
             fmt::format("{} of {} times repeat the one before", steps.repeated, steps.rows));
}

std::string TakenNames::Take(std::string_view wanted) {
  std::string name = PlainNameOf(wanted);
  while (!names_.insert(name).second) name += "_2";
  return name;
}

std::string ColumnYaml(std::string_view column, const UnitGuess& unit) {
  const std::string shown_unit =
      unit.unit == "1" || unit.unit == "%" ? "'" + unit.unit + "'" : unit.unit;
  const std::string scale = unit.scale == 1.0 ? "" : fmt::format(", scale: {}", unit.scale);
  return fmt::format("{{column: {}, unit: {}{}}}", YamlWord(column), shown_unit, scale);
}

std::string DoubtRemark(const UnitGuess& unit) {
  if (unit.doubt.empty()) return "";
  return (unit.is_known() ? "   # guessed: " : "   # to fill in: ") + unit.doubt;
}

}  // namespace tera
