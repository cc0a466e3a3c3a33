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
  std::string kind = "recording";  ///< what an incomplete one is; for its note and for messages
  /// What to do with an incomplete recording; for the same.
  std::string remedy = "go on with it by the same command and --resume, or delete it";
};

/// Writes a recording. Frames are encoded on worker threads behind a bounded queue; rows are
/// written in order by the caller's thread. Everything goes to `<directory>.incomplete` and is
/// renamed to `<directory>` by Finish; every file appears under its name only when whole.
///
/// Throws InputError: directory not empty, not writable, disk full; on resume, a partial dataset of
/// another scenario, seed, version or inputs.
class DatasetWriter : public MeasurementSink {
 public:
  DatasetWriter(const std::filesystem::path& directory, const DatasetInfo& info,
                const WriterOptions& options);
  /// Without Finish, leaves the incomplete directory, its rows as far as the disk takes them.
  ~DatasetWriter() override;

  /// Gives a recording its name that an earlier run had finished but for that. False where there is
  /// none. Throws InputError where it is of another scenario, seed, version or inputs.
  static bool FinishWhole(const std::filesystem::path& directory, const DatasetInfo& info);

  ChannelId AddChannel(const ChannelInfo& info) override;
  /// A channel of rows that another recording has whole: its file is taken over as it is. Nothing
  /// may be written to it. Throws InputError where it is not there or has other columns.
  void AddWholeTable(const ChannelInfo& info, const std::filesystem::path& file);
  void Write(ChannelId channel, Measurement measurement) override;
  /// False when resuming and the files of this channel's frame at `t_ns` are whole already.
  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId channel, TimeNs t_ns) override;
  bool TakesFramesLate() const override { return true; }

  /// Where to put a file of another kind (truth/terrain/*.tif); its folder exists.
  std::filesystem::path PathFor(const std::string& relative);

  /// Hands all rows so far to the system, so that a kill of the program does not lose them.
  void Flush();

  std::int64_t frames_written() const;
  std::int64_t bytes_written() const;

  /// Goes on with a recording that an earlier run began.
  bool resumed() const;
  /// Where everything is until Finish.
  const std::filesystem::path& incomplete_directory() const;

  /// What dataset.yaml says in place of the duration that was given at the start.
  void SetDuration(double duration_s);
  /// Waits for the queue, closes everything and renames the directory into place.
  void Finish();
  /// Gives up: removes the incomplete directory. Nothing may be called after it.
  void Discard();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
