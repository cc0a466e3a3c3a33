#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"
#include "core/types/sample_rows.h"
#include "dataset/format/csv_rows.h"
#include "dataset/format/events_table.h"
#include "dataset/format/row_scan.h"
#include "dataset/lint/checks/stamps.h"
#include "dataset/lint/lint_job.h"

// Every row of every channel of numbers and frames.

namespace tera {
namespace {

/// Axes of an encoder from its column names; empty if these are not encoder columns.
std::vector<EncoderAxis> AxesOf(const std::vector<std::string>& columns) {
  constexpr std::string_view kAngle = "_rad", kTravel = "_m";
  std::vector<EncoderAxis> axes;
  for (std::size_t c = 0; c < columns.size() / 2; ++c) {
    const std::string& column = columns[c];
    const bool linear = column.ends_with(kTravel);
    if (!linear && !column.ends_with(kAngle)) return {};
    axes.push_back(
        {column.substr(0, column.size() - (linear ? kTravel.size() : kAngle.size())), linear});
  }
  return axes;
}

/// Describes the fault of a header; empty if it has none.
std::string HeaderFault(std::string_view type, ChannelForm form, const RowScan& scan) {
  const std::vector<std::string>& columns = scan.columns();
  const std::string found = TableHeader(columns);
  const auto need = [&](const std::string& header) {
    return found == header ? "" : fmt::format("found '{}', need '{}'", found, header);
  };
  if (form != ChannelForm::kRows) return need(std::string(kFrameHeader));
  if (type == kImuChannel) return need(TableHeader(ImuColumns()));
  if (type == kGnssChannel) return need(TableHeader(GnssColumns()));
  if (type == kPoseChannel && columns != PoseColumns(false)) {
    return need(TableHeader(PoseColumns(true)));
  }
  if (type == kEncoderChannel && (columns.empty() || EncoderColumns(AxesOf(columns)) != columns)) {
    return fmt::format("found '{}', need positions (_rad, _m) of all joints, then their rates",
                       found);
  }
  return "";
}

RuleId RuleOf(RowFault fault) {
  switch (fault) {
    case RowFault::kCutOff:
    case RowFault::kFields:
      return "rows.fields";
    case RowFault::kNotFinite:
      return "rows.finite";
    case RowFault::kStamp:
      break;
  }
  return "stamps.increasing";
}

void CheckFilename(LintJob* job, const std::string& channel, const ScannedRow& row,
                   ChannelForm form) {
  const std::string needed =
      fmt::format("{}.{}", row.t_ns, form == ChannelForm::kScans ? "pcd" : "png");
  job->Applies("rows.filename");
  if (row.filename == needed) return;
  job->Find("rows.filename", channel,
            {job->RowsOf(channel), row.line, fmt::format("'{}', need {}", row.filename, needed)});
}

void CheckChannel(LintJob* job, const std::string& channel, ChannelForm form) {
  const std::string file = job->RowsOf(channel);
  RowScan scan(job->Path(file), [&](RowFault fault, int line, const std::string& what) {
    job->Find(RuleOf(fault), channel, {file, line, what});
  });
  const std::string fault = HeaderFault(job->recording().TypeOf(channel), form, scan);
  if (!fault.empty()) {
    job->Find("rows.header", channel, {file, 1, fault});
    job->LeaveOut(channel);
    return;
  }
  StampScan stamps;
  for (ScannedRow row; scan.Next(&row);) {
    stamps.Add(row.t_ns, row.line);
    if (form != ChannelForm::kRows) CheckFilename(job, channel, row, form);
  }
  CheckStamps(job, channel, stamps);
}

}  // namespace

void CheckRows(LintJob* job) {
  const Recording& recording = job->recording();
  const auto pictures = recording.SensorsOf(ChannelForm::kPictures);
  const auto scans = recording.SensorsOf(ChannelForm::kScans);
  const auto form_of = [&](const std::string& path) {
    if (std::count(pictures.begin(), pictures.end(), path) > 0) return ChannelForm::kPictures;
    return std::count(scans.begin(), scans.end(), path) > 0 ? ChannelForm::kScans
                                                            : ChannelForm::kRows;
  };
  for (const ChannelDescription& channel : recording.channels()) {
    if (job->IsLeftOut(channel.path) || channel.type == kEventsChannel) continue;
    for (const RuleId rule : {RuleId("rows.header"), RuleId("rows.fields"), RuleId("rows.finite"),
                              RuleId("stamps.increasing")}) {
      job->Applies(rule);
    }
    try {
      CheckChannel(job, channel.path, form_of(channel.path));
    } catch (const InputError& e) {
      job->Find("rows.header", channel.path, {job->RowsOf(channel.path), 1, e.what()});
      job->LeaveOut(channel.path);
    }
  }
}

}  // namespace tera
