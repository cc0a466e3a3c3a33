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
  int queue_length = 64;  ///< frames waiting before Write blocks
  bool resume = false;
  std::string kind = "recording";  ///< name of an incomplete result, for its note and for messages
  /// Advice on an incomplete recording, for the same.
  std::string remedy = "go on with it by the same command and --resume, or delete it";
};

/// Writes a recording. Worker threads behind a bounded queue encode frames; the caller's thread
/// writes rows in order. Everything goes to `<directory>.incomplete`, which Finish renames to
/// `<directory>`. Every file appears under its name only when complete.
///
/// Throws  InputError: directory not empty, not writable, disk full; on resume, a partial dataset
///         of another scenario, seed, version or inputs.
class DatasetWriter : public MeasurementSink {
 public:
  DatasetWriter(const std::filesystem::path& directory, const DatasetInfo& info,
                const WriterOptions& options);
  /// Without Finish, leaves the incomplete directory with its rows as far as the disk takes them.
  ~DatasetWriter() override;

  /// Renames a recording that an earlier run finished except for the rename. Returns false if there
  /// is none. Throws InputError if it is of another scenario, seed, version or inputs.
  static bool FinishWhole(const std::filesystem::path& directory, const DatasetInfo& info);

  ChannelId AddChannel(const ChannelInfo& info) override;
  /// Adds a channel of rows by copying the complete file of another recording. The channel accepts
  /// no further rows. Throws InputError if the file is missing or has other columns.
  void AddWholeTable(const ChannelInfo& info, const std::filesystem::path& file);
  /// Adds a table with its whole text, header included. The channel accepts no further rows.
  void AddWholeText(const ChannelInfo& info, const std::string& text);
  void Write(ChannelId channel, Measurement measurement) override;
  /// False when resuming and the files of this channel's frame at `t_ns` are complete.
  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId channel, TimeNs t_ns) override;
  bool AcceptsOutOfOrderFrames() const override { return true; }

  /// Path for a file of another kind (truth/terrain/*.tif); its folder exists.
  std::filesystem::path PathFor(const std::string& relative);

  /// Passes all rows so far to the system, so that a kill of the program does not lose them.
  void Flush();

  std::int64_t frames_written() const;
  std::int64_t bytes_written() const;

  /// Whether it continues a recording of an earlier run.
  bool resumed() const;
  /// Path of all files until Finish.
  const std::filesystem::path& incomplete_directory() const;

  /// Replaces the initial duration in dataset.yaml.
  void SetDuration(double duration_s);
  /// Waits for the queue, closes everything and renames the directory into place.
  void Finish();
  /// Removes the incomplete directory. No call may follow.
  void Discard();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
