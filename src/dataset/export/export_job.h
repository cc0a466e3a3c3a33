#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/export/export_options.h"
#include "dataset/export/record_stream.h"
#include "dataset/format/recording.h"

namespace tera {

class FrameLog;

/// Input, output and state of an export. Each format is a function that takes an ExportJob.
struct ExportJob {
  const Recording& recording;
  const std::filesystem::path& folder;  ///< output folder; exists and is empty
  std::string name;                     ///< final name of the output folder
  const ExportOptions& options;
  std::int64_t records = 0;   ///< number of records read
  std::int64_t messages = 0;  ///< number of messages written to a bag
  AbsentPictures absent = {};
  FrameLog* whole_frames = nullptr;  ///< only for formats that resume after complete frames
  bool frames_written = false;       ///< true if some complete frames exist
  std::optional<std::vector<JointTree>> known_joint_trees = std::nullopt;

  /// Reads the next record of a stream, which must be in order of time. Reports progress.
  bool Next(RecordStream* stream, Record* record);
  /// True if a stopped export completed the files of this frame. `of` is a channel or another list
  /// of frames; `frame` is a time or an index in that list.
  bool IsWritten(const std::string& of, std::int64_t frame) const;
  /// Logs the files of a frame as complete.
  void Written(const std::string& of, std::int64_t frame,
               const std::vector<std::filesystem::path>& files);
  /// Joint trees of all machines, loaded at the first call.
  const std::vector<JointTree>& JointTrees();
  const JointTree* JointTreeOf(const std::string& machine);  ///< null if unknown
  /// Converts a time of the recording to the time that the format stores. `without_date` is the UTC
  /// of time 0 for a recording without an epoch. It is 0 for a format that needs no date.
  TimeNs Stamp(TimeNs t_ns, TimeNs without_date = 0) const;
};

/// Throws InputError if `paths` is empty: the recording has no channel that the format needs.
void RequireAny(const std::vector<std::string>& paths, const ExportJob& job,
                std::string_view needed);

/// Name of the machine: "excavator1" for "truth/excavator1/pose.csv" or "excavator1/gnss_left".
std::string MachineOf(const std::string& path);

// One function per format.
void ExportTum(ExportJob* job);
void ExportEuroc(ExportJob* job);
void ExportNmea(ExportJob* job);
void ExportPos(ExportJob* job);
void ExportRosbag2(ExportJob* job);
void ExportBag(ExportJob* job);
void ExportPcd(ExportJob* job);
void ExportPly(ExportJob* job);
void ExportLas(ExportJob* job);
void ExportCoco(ExportJob* job);
void ExportKitti(ExportJob* job);
void ExportSemanticKitti(ExportJob* job);
void ExportWebdataset(ExportJob* job);
void ExportNuscenes(ExportJob* job);
void ExportPackets(ExportJob* job);

}  // namespace tera
