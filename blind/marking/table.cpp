#include "blind/marking/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace tera::blind {
namespace {

constexpr double kZ = 1.959964;  ///< of 95 %
constexpr double kShows_s = 6;   ///< of an effect that a second one can be told by

using Test = std::function<bool(const Mark&)>;

/// Half of Wilson's interval's width and its middle.
std::pair<double, double> Wilson(const Share& share) {
  const double n = share.cases, p = share.value(), z2 = kZ * kZ;
  const double middle = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {middle, half};
}

Row ShareOf(const std::vector<Mark>& marks, const std::string& measure, const std::string& target,
            const Test& counts, const Test& hits) {
  Row row{measure, target};
  for (const Mark& mark : marks) {
    if (!mark.fault.empty() || !counts(mark)) continue;
    ++row.share.cases;
    if (hits(mark)) ++row.share.hits;
  }
  row.cases = row.share.cases;
  return row;
}

double Quantile(std::vector<double> values, double at) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(at * static_cast<double>(values.size() - 1) + 0.5)];
}

Row ValueOf(const std::string& measure, const std::string& target, std::vector<double> values,
            double at) {
  Row row{measure, target};
  row.is_share = false;
  row.cases = static_cast<int>(values.size());
  row.value = Quantile(std::move(values), at);
  return row;
}

nlohmann::ordered_json JsonOf(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

Test Is(CaseKind kind) {
  return [kind](const Mark& mark) { return mark.kind == kind; };
}

Test IsOne(Strength strength) {
  return [strength](const Mark& mark) {
    return mark.kind == CaseKind::kOne && mark.strength == strength;
  };
}

void AddNames(const std::vector<Mark>& marks, std::vector<Row>* rows) {
  rows->push_back(ShareOf(marks, "false alarm where nothing is wrong", "≤ 2 %",
                          Is(CaseKind::kNothing), &Mark::found_something));
  const std::pair<Strength, const char*> strengths[] = {
      {Strength::kStrong, "≥ 95 %"}, {Strength::kMedium, "≥ 88 %"}, {Strength::kFaint, "≥ 60 %"}};
  for (const auto& [strength, target] : strengths) {
    rows->push_back(ShareOf(marks, fmt::format("right name first, {} effect", NameOf(strength)),
                            target, IsOne(strength), &Mark::right_first));
  }
  rows->push_back(ShareOf(
      marks, "confident wrong name, all cases", "≤ 2 %", [](const Mark&) { return true; },
      &Mark::confident_wrong));
  const auto both_show = [](const Mark& mark) {
    return mark.kind == CaseKind::kTwo && mark.shows_s >= kShows_s;
  };
  rows->push_back(ShareOf(marks,
                          fmt::format("two effects, each showing for {:.0f} s: both", kShows_s),
                          "≥ 75 %", both_show, [](const Mark& mark) { return mark.named == 2; }));
  rows->push_back(ShareOf(marks, "two effects, all cases: both", "≥ 75 %", Is(CaseKind::kTwo),
                          [](const Mark& mark) { return mark.named == 2; }));
  rows->push_back(ShareOf(marks, "two effects: at least one", "≥ 97 %", Is(CaseKind::kTwo),
                          [](const Mark& mark) { return mark.named >= 1; }));
  rows->push_back(
      ShareOf(marks, "two effects: a spurious one", "≤ 10 %", Is(CaseKind::kTwo), &Mark::spurious));
  rows->push_back(ShareOf(marks, "outside the library: flagged with the right variable", "≥ 85 %",
                          Is(CaseKind::kOutside), &Mark::right_variable_flagged));
  rows->push_back(ShareOf(marks, "outside the library: misnamed", "≤ 8 %", Is(CaseKind::kOutside),
                          &Mark::misnamed));
  rows->push_back(ShareOf(marks, "confounded: the true one in the class", "",
                          Is(CaseKind::kConfounded),
                          [](const Mark& mark) { return mark.named == 1; }));
  rows->push_back(ShareOf(marks, "injected into a real drive: named", "", Is(CaseKind::kInjected),
                          [](const Mark& mark) { return mark.named == 1; }));
  rows->push_back(ShareOf(marks, "untestable: nothing named", "", Is(CaseKind::kUntestable),
                          [](const Mark& mark) { return !mark.found_something; }));
}

void AddNumbers(const std::vector<Mark>& marks, std::vector<Row>* rows) {
  std::vector<double> errors, overlaps, seconds, shares;
  Row coverage{"parameter: 90 % interval covers", "85–95 %"};
  for (const Mark& mark : marks) {
    if (!mark.fault.empty()) continue;
    seconds.push_back(mark.seconds * 600 / mark.recorded_s);
    if (mark.share_of_oracle) shares.push_back(*mark.share_of_oracle);
    if (mark.located && mark.right_channel) overlaps.push_back(mark.overlap);
    for (const ParameterMark& parameter : mark.parameters) {
      errors.push_back(parameter.RelativeError());
      ++coverage.share.cases;
      if (parameter.Covered()) ++coverage.share.hits;
    }
  }
  coverage.cases = coverage.share.cases;
  const char* improvement = "share of the oracle's improvement on held-out manoeuvres";
  rows->push_back(ValueOf(fmt::format("{}, median", improvement), "≥ 0.90", shares, 0.5));
  rows->push_back(ValueOf(fmt::format("{}, 10th percentile", improvement), "≥ 0.70", shares, 0.1));
  rows->push_back(ValueOf("parameter error, median", "≤ 0.10", errors, 0.5));
  rows->push_back(coverage);
  const Test located = &Mark::located;
  rows->push_back(ShareOf(marks, "located: channel", "≥ 97 %", located, &Mark::right_channel));
  rows->push_back(ShareOf(
      marks, "located: variable, where the effect has one", "≥ 90 %",
      [](const Mark& mark) { return mark.located && mark.has_variable; }, &Mark::right_variable));
  rows->push_back(ValueOf("located: interval overlap, median", "≥ 0.7", overlaps, 0.5));
  rows->push_back(ValueOf("seconds for 600 s of two joints, median", "≤ 240", seconds, 0.5));
}

}  // namespace

double Share::low() const {
  if (cases == 0) return 0;
  const auto [middle, half] = Wilson(*this);
  return std::max(0.0, middle - half);
}

double Share::high() const {
  if (cases == 0) return 1;
  const auto [middle, half] = Wilson(*this);
  return std::min(1.0, middle + half);
}

std::string Row::Text() const {
  if (cases == 0) return "no case";
  if (!is_share) return fmt::format("{:.3g} ({} values)", value, cases);
  return fmt::format("{:.0f} % ({} of {}; {:.0f}–{:.0f} %)", 100 * share.value(), share.hits,
                     share.cases, 100 * share.low(), 100 * share.high());
}

std::vector<Row> TableOf(const std::vector<Mark>& marks) {
  std::vector<Row> rows;
  AddNames(marks, &rows);
  AddNumbers(marks, &rows);
  return rows;
}

std::vector<MethodRow> MethodsOf(const std::vector<Mark>& marks) {
  std::vector<MethodRow> rows = {
      {.method = "tera diagnose", .false_alarm = Share{}, .right_first = Share{}}};
  const auto count = [](const Mark& mark, bool found, bool right, MethodRow* row) {
    if (mark.kind == CaseKind::kNothing && row->false_alarm) {
      ++row->false_alarm->cases;
      row->false_alarm->hits += found ? 1 : 0;
    }
    if (mark.kind == CaseKind::kOne && row->right_first) {
      ++row->right_first->cases;
      row->right_first->hits += right ? 1 : 0;
    }
  };
  for (const Mark& mark : marks) {
    if (mark.methods.empty()) continue;  // the same cases for all
    count(mark, mark.found_something, mark.right_first, &rows[0]);
    if (mark.share_of_oracle) rows[0].shares.push_back(*mark.share_of_oracle);
    for (std::size_t m = 0; m < mark.methods.size(); ++m) {
      const MethodMark& one = mark.methods[m];
      if (rows.size() <= m + 1) {
        rows.push_back({.method = one.method});
        if (one.gives_findings) rows.back().false_alarm = Share{};
        if (one.gives_names) rows.back().right_first = Share{};
      }
      count(mark, one.found, one.right_first, &rows[m + 1]);
      if (one.share) rows[m + 1].shares.push_back(*one.share);
    }
  }
  for (MethodRow& row : rows) std::sort(row.shares.begin(), row.shares.end());
  return rows;
}

std::string MethodsMarkdown(const std::vector<MethodRow>& rows) {
  std::string text =
      "| method | false alarm | right name first, one effect | share of the oracle's improvement: "
      "median | 10th percentile |\n| --- | --- | --- | --- | --- |\n";
  const auto share = [](const std::optional<Share>& one) {
    return one ? fmt::format("{} of {}", one->hits, one->cases) : std::string("gives none");
  };
  for (const MethodRow& row : rows) {
    const std::string shares =
        row.shares.empty() ? "no case | no case"
                           : fmt::format("{:.2f} | {:.2f} ({} cases)", Quantile(row.shares, 0.5),
                                         Quantile(row.shares, 0.1), row.shares.size());
    text += fmt::format("| {} | {} | {} | {} |\n", row.method, share(row.false_alarm),
                        share(row.right_first), shares);
  }
  return text;
}

std::string TableMarkdown(const std::vector<Row>& rows) {
  std::string text = "| measure | target | reached (95 % interval) |\n| --- | --- | --- |\n";
  for (const Row& row : rows) {
    text += fmt::format("| {} | {} | {} |\n", row.measure, row.target, row.Text());
  }
  return text;
}

std::string CaseLine(const Mark& mark) {
  return fmt::format("| {} | {} | {} | {:.1f} | {} | {} | {:.0f} |\n", mark.number + 1,
                     NameOf(mark.kind), HasStrength(mark.kind) ? NameOf(mark.strength) : "",
                     mark.signal_to_noise, fmt::join(mark.hidden, "; "),
                     mark.fault.empty() ? fmt::format("{}", fmt::join(mark.answered, "; "))
                                        : "no answer: " + mark.fault,
                     mark.seconds);
}

std::string CasesMarkdown(const std::vector<Mark>& marks) {
  std::string text =
      "| case | kind | strength | signal / noise | hidden | answered | s |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Mark& mark : marks) text += CaseLine(mark);
  return text;
}

std::string TableJson(const std::vector<Row>& rows, const std::vector<Mark>& marks,
                      std::uint64_t seed) {
  nlohmann::ordered_json json = {{"seed", seed}, {"cases", marks.size()}};
  json["table"] = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json one = {{"measure", row.measure}, {"target", row.target}};
    one["cases"] = row.cases;
    if (row.is_share) {
      one["hits"] = row.share.hits;
      one["share"] = row.share.value();
      one["low"] = row.share.low();
      one["high"] = row.share.high();
    } else {
      one["value"] = row.value;
    }
    json["table"].push_back(one);
  }
  json["marks"] = nlohmann::ordered_json::array();
  for (const Mark& mark : marks) {
    nlohmann::ordered_json one = {{"case", mark.number + 1},
                                  {"kind", std::string(NameOf(mark.kind))},
                                  {"fault", mark.fault},
                                  {"seconds", mark.seconds},
                                  {"signal_to_noise", mark.signal_to_noise},
                                  {"shows_s", mark.hidden.empty() ? 0 : mark.shows_s},
                                  {"hidden", mark.hidden},
                                  {"answered", mark.answered},
                                  {"right_first", mark.right_first},
                                  {"named", mark.named},
                                  {"spurious", mark.spurious},
                                  {"confident_wrong", mark.confident_wrong},
                                  {"overlap", mark.overlap}};
    if (HasStrength(mark.kind)) one["strength"] = NameOf(mark.strength);
    one["share_of_oracle"] = JsonOf(mark.share_of_oracle);
    one["methods"] = nlohmann::ordered_json::array();
    for (const MethodMark& m : mark.methods) {
      one["methods"].push_back({{"method", m.method},
                                {"found", m.found},
                                {"right_first", m.right_first},
                                {"share_of_oracle", JsonOf(m.share)}});
    }
    one["parameters"] = nlohmann::ordered_json::array();
    for (const ParameterMark& p : mark.parameters) {
      one["parameters"].push_back({{"effect", p.effect},
                                   {"parameter", p.parameter},
                                   {"truth", p.truth},
                                   {"value", p.value},
                                   {"sigma", p.sigma}});
    }
    json["marks"].push_back(one);
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tera::blind
