#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "dataset/files/whole_folder.h"
#include "dataset/format/dataset_info.h"
#include "dataset/format/measurement_sink.h"

namespace tera {

struct WriterOptions {
  int threads = 2;        ///< encoding threads
  int queue_length = 64;  ///< number of queued frames at which Write blocks
  bool resume = false;
  std::string kind = "recording";  ///< word for the result in messages and in the note of an
                                   ///< incomplete result
  /// Advice in messages about an incomplete result.
  std::string remedy = "resume it by the same command with --resume, or delete it";
};

/// Writes a recording. Worker threads encode frames from a bounded queue. The calling thread writes
/// rows, in order. All files go to `<directory>.incomplete`; Finish renames it to `<directory>`. A
/// file has its final name only when it is complete.
///
/// Throws  InputError if the directory is not empty or not writable, or if the disk is full. When
///         resuming, also if the partial dataset has another scenario, seed, version or inputs.
class DatasetWriter : public MeasurementSink {
 public:
  DatasetWriter(const std::filesystem::path& directory, const DatasetInfo& info,
                const WriterOptions& options);
  /// Without a call of Finish, the incomplete directory stays, with all rows that fit on the disk.
  ~DatasetWriter() override;

  /// Renames a recording that is complete except for the final rename. Returns false if there is
  /// none. Throws InputError if it has another scenario, seed, version or inputs.
  static bool FinishWhole(const std::filesystem::path& directory, const DatasetInfo& info);

  ChannelId AddChannel(const ChannelInfo& info) override;
  /// Adds a channel of rows as a copy of a complete file from another recording. No more rows can
  /// be added. Throws InputError if the file is missing or has other columns.
  void AddWholeTable(const ChannelInfo& info, const std::filesystem::path& file);
  /// Adds a table with its whole text, header included. The channel accepts no further rows.
  void AddWholeText(const ChannelInfo& info, const std::string& text);
  void Write(ChannelId channel, Measurement measurement) override;
  /// False if an earlier run has completed the files of this frame and the writer resumes that run.
  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId channel, TimeNs t_ns) override;
  bool AcceptsOutOfOrderFrames() const override { return true; }

  /// Path for a file of another kind, such as truth/terrain/*.tif. Its folder is created.
  std::filesystem::path PathFor(const std::string& relative);

  /// Passes all rows to the operating system, so that they survive a kill of the program.
  void Flush();

  std::int64_t frames_written() const;
  std::int64_t bytes_written() const;

  /// True if this writer continues a recording of an earlier run.
  bool resumed() const;
  /// Directory of all files until Finish renames it.
  const std::filesystem::path& incomplete_directory() const;

  /// Replaces the duration that dataset.yaml was created with.
  void SetDuration(double duration_s);
  /// Waits for queued frames, closes all files and renames the directory.
  void Finish();
  /// Deletes the incomplete directory. No other call may follow.
  void Discard();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
