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

/// What a format is written from and where. Each format is one function of it.
struct ExportJob {
  const Recording& recording;
  const std::filesystem::path& folder;  ///< to write into; it is there and empty
  std::string name;                     ///< of the folder in its final place
  const ExportOptions& options;
  std::int64_t records = 0;   ///< read so far
  std::int64_t messages = 0;  ///< of a bag, written so far
  AbsentPictures absent = {};
  FrameLog* whole_frames = nullptr;  ///< of formats that go on by frames
  bool frames_written = false;       ///< some are there to be gone on with
  std::optional<std::vector<JointTree>> known_joint_trees = std::nullopt;

  /// The next record of a stream, which must be in order of time, with progress told.
  bool Next(RecordStream* stream, Record* record);
  /// Whether the files of a frame are whole already, from an export that was stopped. `of` is a
  /// channel or another list of frames, `frame` a time or a number in it.
  bool IsWritten(const std::string& of, std::int64_t frame) const;
  /// Says that they are whole now.
  void Written(const std::string& of, std::int64_t frame,
               const std::vector<std::filesystem::path>& files);
  /// Asked for at the first call.
  const std::vector<JointTree>& JointTrees();
  const JointTree* JointTreeOf(const std::string& machine);  ///< null: not known
  /// What a time of the recording is in the format; `without_date` where nobody gave the date.
  TimeNs Stamp(TimeNs t_ns, TimeNs without_date = 0) const;
};

/// Throws InputError: the recording has none of the channels that a format consists of.
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

}  // namespace tera
