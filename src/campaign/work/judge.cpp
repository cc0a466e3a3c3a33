#include "campaign/work/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/overloaded.h"
#include "core/units.h"
#include "dataset/format/object_boxes.h"
#include "dataset/format/recording.h"
#include "dataset/format/row_scan.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void FailRule(const fs::path& dataset, const std::string& finding) {
  throw InputError(dataset.string(), {FaultKind::kMissing, finding});
}

double ShareOf(const SeenShare& seen, const Recording& recording) {
  std::vector<std::string> cameras = recording.SensorsOf(ChannelForm::kPictures);
  if (!seen.camera.empty()) cameras = {seen.camera};
  std::int64_t frames = 0, with = 0;
  for (const std::string& camera : cameras) {
    for (const TimeNs t_ns : recording.FrameTimes(camera)) {
      const fs::path file = recording.directory() / camera / "boxes" / fmt::format("{}.json", t_ns);
      if (!fs::exists(file)) {
        FailRule(file, "is missing; a rule on seen shares needs cameras with labels: true");
      }
      const std::vector<ObjectBox> boxes = ReadBoxes(file);
      ++frames;
      with += std::any_of(boxes.begin(), boxes.end(), [&](const ObjectBox& box) {
        return box.label == seen.label && box.visible_px >= seen.visible_px;
      });
    }
  }
  if (frames == 0) FailRule(recording.directory(), "has no frame of the cameras that a rule needs");
  return static_cast<double>(with) / static_cast<double>(frames);
}

double FigureOfColumn(const TableColumn& figure, const Recording& recording) {
  fs::path file = recording.directory() / figure.table;
  if (fs::is_directory(file)) file /= "data.csv";
  if (!fs::exists(file)) FailRule(file, "is missing, but a rule needs it");
  RowScan scan(file);
  const auto found = std::find(scan.columns().begin(), scan.columns().end(), figure.column);
  if (found == scan.columns().end()) {
    FailRule(file, fmt::format("has no column '{}', which a rule needs", figure.column));
  }
  const auto column = static_cast<std::size_t>(found - scan.columns().begin());
  double largest = -INFINITY, least = INFINITY, sum = 0, last = 0;
  std::int64_t rows = 0;
  for (ScannedRow row; scan.Next(&row); ++rows) {
    last = row.values[column];
    largest = std::max(largest, last);
    least = std::min(least, last);
    sum += last;
  }
  if (rows == 0) FailRule(file, "has no rows, but a rule needs them");
  switch (figure.figure) {
    case ColumnFigure::kLeast:
      return least;
    case ColumnFigure::kMean:
      return sum / static_cast<double>(rows);
    case ColumnFigure::kLast:
      return last;
    case ColumnFigure::kLargest:
      break;
  }
  return largest;
}

double TiltDegOf(const LargestTilt& tilt, const Recording& recording) {
  double least_cosine = 1;
  for (const TruthPose& pose : recording.LoadPose("truth/" + tilt.machine + "/pose.csv").poses) {
    least_cosine = std::min(least_cosine, pose.X_WB.linear()(2, 2));
  }
  return std::acos(std::max(-1.0, least_cosine)) / kDeg;
}

}  // namespace

double FigureOf(const AcceptanceRule& rule, const fs::path& dataset) {
  const Recording recording(dataset);
  return std::visit(
      Overloaded{[&](const SeenShare& seen) { return ShareOf(seen, recording); },
                 [&](const TableColumn& column) { return FigureOfColumn(column, recording); },
                 [&](const LargestTilt& tilt) { return TiltDegOf(tilt, recording); }},
      rule.figure);
}

std::optional<std::string> BrokenRule(const std::vector<AcceptanceRule>& rules,
                                      const fs::path& dataset) {
  for (const AcceptanceRule& rule : rules) {
    const double figure = FigureOf(rule, dataset);
    if (figure < rule.at_least || figure > rule.at_most) return rule.name;
  }
  return std::nullopt;
}

}  // namespace tera
