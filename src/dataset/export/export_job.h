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

/// Input and output of an export. Each format is one function of it.
struct ExportJob {
  const Recording& recording;
  const std::filesystem::path& folder;  ///< existing and empty
  std::string name;                     ///< final name of the folder
  const ExportOptions& options;
  std::int64_t records = 0;   ///< read so far
  std::int64_t messages = 0;  ///< written to a bag so far
  AbsentPictures absent = {};
  FrameLog* whole_frames = nullptr;  ///< for formats that resume by frames
  bool frames_written = false;       ///< some complete frames exist
  std::optional<std::vector<JointTree>> known_joint_trees = std::nullopt;

  /// The next record of a stream, which must be in order of time. Reports progress.
  bool Next(RecordStream* stream, Record* record);
  /// Whether a stopped export has completed the files of a frame. `of` is a channel or another list
  /// of frames, `frame` a time or an index in it.
  bool IsWritten(const std::string& of, std::int64_t frame) const;
  /// Marks the files of a frame as complete.
  void Written(const std::string& of, std::int64_t frame,
               const std::vector<std::filesystem::path>& files);
  /// Loaded at the first call.
  const std::vector<JointTree>& JointTrees();
  const JointTree* JointTreeOf(const std::string& machine);  ///< null: unknown
  /// The format's time for a time of the recording. `without_date` applies if the date is unknown.
  TimeNs Stamp(TimeNs t_ns, TimeNs without_date = 0) const;
};

/// Throws InputError if the recording has none of the channels of a format.
void RequireAny(const std::vector<std::string>& paths, const ExportJob& job,
                std::string_view needed);

/// "excavator1", from "truth/excavator1/pose.csv" and from "excavator1/gnss_left".
std::string MachineOf(const std::string& path);

// The formats.
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
