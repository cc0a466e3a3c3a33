#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "dataset/format/recording.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/lint/lint.h"

namespace tera {

/// State of a running lint: the dataset and the findings so far.
class LintJob {
 public:
  LintJob(const Recording& recording, const LintOptions& options);

  const Recording& recording() const { return recording_; }
  const LintOptions& options() const { return options_; }
  DatasetStatistics& statistics() { return statistics_; }

  /// Records that the dataset has data to which a rule applies.
  void Applies(RuleId rule) { applied_.insert(rule.index()); }
  void Find(RuleId rule, const std::string& channel, LintPlace place);

  /// Runs a check of a channel. If the check fails to read data, adds a finding and continues.
  void Try(const std::string& channel, const std::function<void()>& check);

  /// Excludes a channel with unreadable rows from later checks.
  void LeaveOut(const std::string& channel) { left_out_.insert(channel); }
  bool IsLeftOut(const std::string& channel) const { return left_out_.contains(channel); }

  /// Content of the sensor's sensor.yaml; nullopt if unreadable.
  std::optional<SensorSheet> SheetOf(const std::string& channel) const;
  /// Path of a channel's rows, relative to the dataset.
  std::string RowsOf(const std::string& channel) const;
  std::filesystem::path Path(const std::string& file) const {
    return recording_.directory() / file;
  }

  bool HasClass(int id) const { return class_names_.contains(id); }
  /// Empty if dataset.yaml does not list the id.
  std::string ClassName(int id) const;
  /// Null if dataset.yaml does not list the id.
  const DatasetInfo::Instance* InstanceOf(std::uint16_t id) const;

  LintReport Report() &&;

 private:
  const Recording& recording_;
  const LintOptions& options_;
  DatasetStatistics statistics_;
  std::set<std::size_t> applied_;
  std::map<std::pair<std::size_t, std::string>, LintFinding> findings_;
  std::set<std::string> left_out_;
  std::map<int, std::string> class_names_;
  std::map<std::uint16_t, DatasetInfo::Instance> instances_;
};

std::string MachineOfChannel(const std::string& channel);

// The checks. Each covers one topic and adds its findings to the job.
void CheckDescription(LintJob* job);  ///< rules dataset.*
void CheckFiles(LintJob* job);        ///< rules files.* except files.hash
void CheckHashes(LintJob* job);       ///< rule files.hash
void CheckRows(LintJob* job);         ///< rules rows.* and stamps.*
void CheckPoses(LintJob* job);
void CheckCommands(LintJob* job);
void CheckEncoders(LintJob* job);
void CheckInertialUnits(LintJob* job);
void CheckReceivers(LintJob* job);
void CheckEvents(LintJob* job);
void CheckCameras(LintJob* job);  ///< pictures.*, boxes.*
void CheckLidars(LintJob* job);   ///< scans.* except depth
void CheckScansByDepth(LintJob* job);
void CheckFlowByPoses(LintJob* job);

}  // namespace tera
