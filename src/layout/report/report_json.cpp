#include "layout/report/report_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

using nlohmann::json;

constexpr int kFormat = 2;  ///< format 1 counts people and elevations differently
constexpr int kIndent = 1;

json FigureJson(const Figure& f) {
  return {{"name", NameOf(f.id)},
          {"unit", UnitOf(f.id.measure)},
          {"more_is_better", IsMoreBetter(f.id.measure)},
          {"mean", MeanOf(f)},
          {"worst", WorstOf(f)},
          {"sampling_error", ErrorOf(f)},
          {"at", f.at},
          {"sampling_error_at", f.error}};
}

FigureId ReadId(const json& from) {
  const std::string name = from.at("name");
  if (const auto id = FigureIdOf(name)) return *id;
  throw InputError(
      "", {FaultKind::kNoSuchName, fmt::format("'{}' is an unknown figure, map or curve", name)});
}

Figure ReadFigure(const json& from) {
  const FigureId id = ReadId(from);
  if (from.at("unit") != UnitOf(id.measure) ||
      from.at("more_is_better") != IsMoreBetter(id.measure)) {
    throw InputError(
        fmt::format("figure '{}' has another unit or direction of improvement", NameOf(id)));
  }
  return {id, from.at("at"), from.at("sampling_error_at")};
}

json MapJson(const PolarMap& m) {
  return {{"name", NameOf(m.id)}, {"title", m.title},   {"sectors", m.sectors},
          {"rings", m.rings},     {"ring_m", m.ring_m}, {"ring_unit", m.ring_unit},
          {"low", m.low},         {"high", m.high},     {"value", m.value},
          {"ticks", m.ticks}};
}

PolarMap ReadMap(const json& from) {
  PolarMap map{ReadId(from),      from.at("title"),     from.at("sectors"), from.at("rings"),
               from.at("ring_m"), from.at("ring_unit"), from.at("low"),     from.at("high"),
               from.at("value"),  from.at("ticks")};
  if (map.sectors <= 0 || map.rings <= 0 ||
      map.value.size() != static_cast<std::size_t>(map.sectors) * map.rings) {
    throw InputError(fmt::format("map '{}' does not have one value for each cell", NameOf(map.id)));
  }
  return map;
}

json CurveJson(const PolarCurve& c) {
  return {{"name", NameOf(c.id)}, {"title", c.title}, {"most", c.most},
          {"mean", c.mean},       {"worst", c.worst}, {"worst_from", c.worst_from}};
}

PolarCurve ReadCurve(const json& from) {
  return {ReadId(from),    from.at("title"), from.at("most"),
          from.at("mean"), from.at("worst"), from.at("worst_from")};
}

LayoutReport FromJson(const json& from) {
  if (from.at("format") != kFormat) {
    throw InputError("", {FaultKind::kUnsupported, fmt::format("has format {}, need {}",
                                                               from.at("format").dump(), kFormat)});
  }
  LayoutReport report;
  report.name = from.at("name");
  report.file = from.at("rig");
  report.cycle = from.at("cycle");
  report.asked_sha256 = from.at("asked_sha256");
  from.at("viewers").get_to(report.viewers);
  const json& expense = from.at("expense");
  report.expense = {expense.at("cost"),    expense.at("power_w"), expense.at("data_mbyteps"),
                    expense.at("sensors"), expense.at("priced"),  expense.at("powered")};
  from.at("t_s").get_to(report.t_s);
  from.at("outline_m").get_to(report.outline_m);
  if (report.t_s.empty()) throw InputError("", {FaultKind::kMissing, "has no moments"});
  for (const json& figure : from.at("figures")) report.figures.push_back(ReadFigure(figure));
  for (const json& map : from.at("maps")) report.maps.push_back(ReadMap(map));
  for (const json& curve : from.at("curves")) report.curves.push_back(ReadCurve(curve));
  from.at("blind_causes").get_to(report.blind_causes);
  from.at("overlaps").get_to(report.overlaps);
  from.at("warnings").get_to(report.warnings);
  for (const Figure& figure : report.figures) {
    if (figure.at.size() == report.t_s.size() &&
        (figure.error.empty() || figure.error.size() == report.t_s.size())) {
      continue;
    }
    throw InputError(
        fmt::format("figure '{}' does not have one value for each moment", NameOf(figure.id)));
  }
  return report;
}

}  // namespace

std::string ReportJson(const LayoutReport& report) {
  json out = {{"format", kFormat},
              {"name", report.name},
              {"rig", report.file},
              {"cycle", report.cycle},
              {"asked_sha256", report.asked_sha256},
              {"viewers", report.viewers},
              {"expense",
               {{"cost", report.expense.cost},
                {"power_w", report.expense.power_w},
                {"data_mbyteps", report.expense.data_mbyteps},
                {"sensors", report.expense.sensors},
                {"priced", report.expense.priced},
                {"powered", report.expense.powered}}},
              {"t_s", report.t_s},
              {"outline_m", report.outline_m},
              {"figures", json::array()},
              {"maps", json::array()},
              {"curves", json::array()},
              {"blind_causes", report.blind_causes},
              {"overlaps", report.overlaps},
              {"warnings", report.warnings}};
  for (const Figure& figure : report.figures) out["figures"].push_back(FigureJson(figure));
  for (const PolarMap& map : report.maps) out["maps"].push_back(MapJson(map));
  for (const PolarCurve& curve : report.curves) out["curves"].push_back(CurveJson(curve));
  // File names may contain invalid UTF-8.
  return out.dump(kIndent, ' ', false, json::error_handler_t::replace) + "\n";
}

LayoutReport ReadReport(const std::filesystem::path& file_or_folder) {
  std::error_code ignored;
  const std::filesystem::path file = std::filesystem::is_directory(file_or_folder, ignored)
                                         ? file_or_folder / "layout.json"
                                         : file_or_folder;
  if (!std::filesystem::exists(file, ignored)) {
    throw InputError(file.string(),
                     {FaultKind::kUnreadable,
                      "is missing; need the folder of a rig that `tera layout evaluate` wrote"});
  }
  const std::string text = ReadWholeFile(file);
  try {
    return FromJson(json::parse(text));
  } catch (const json::parse_error& error) {
    throw InputError(file.string(),
                     {FaultKind::kMalformed,
                      fmt::format("is not valid JSON at byte {} of {}; evaluate the rig again",
                                  error.byte, text.size())});
  } catch (const json::exception&) {
    throw InputError(file.string(),
                     {FaultKind::kMalformed,
                      "is not a report of `tera layout evaluate`; evaluate the rig again"});
  } catch (const InputError& error) {
    throw InputError(file.string(),
                     {FaultKind::kMalformed,
                      fmt::format("{}; need a report of `tera layout evaluate`", error.what())});
  }
}

}  // namespace tera
