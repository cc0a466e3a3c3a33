#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "core/units.h"
#include "dataset/export/export_job.h"
#include "dataset/export/gnss/nmea_sentences.h"
#include "dataset/export/record_views.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/antenna_pair.h"
#include "dataset/format/recording.h"

namespace tera {
namespace {

/// Output file of a receiver, and its antenna pair if it has one.
struct Receiver {
  std::unique_ptr<CheckedFile> file;
  std::optional<AntennaPair> pair;  ///< set for the first receiver of the pair
  std::size_t second = 0;
  GnssSample last;
  bool measured = false;
};

std::vector<Receiver> OpenReceivers(const ExportJob& job, const std::vector<std::string>& paths) {
  std::vector<Receiver> receivers(paths.size());
  std::map<std::string, std::vector<std::size_t>> of_machine;
  for (std::size_t r = 0; r < paths.size(); ++r) {
    const std::filesystem::path file = job.folder / (paths[r] + ".nmea");
    MakeFolder(file.parent_path());
    receivers[r].file = std::make_unique<CheckedFile>(file);
    of_machine[MachineOf(paths[r])].push_back(r);
  }
  for (const auto& [machine, own] : of_machine) {
    std::vector<std::string> names;
    for (const std::size_t r : own) names.push_back(paths[r]);
    receivers[own.front()].pair = AntennaPair::Of(job.recording, names);
    receivers[own.front()].second = own.back();
  }
  return receivers;
}

bool HasFixAt(const Receiver& receiver, TimeNs t_ns) {
  return receiver.measured && receiver.last.t_ns == t_ns && receiver.last.fix != GnssFix::kNone;
}

/// Appends a heading sentence once both receivers of a pair have a fix at this time.
void AppendHeading(TimeNs t_ns, std::vector<Receiver>* receivers) {
  for (Receiver& first : *receivers) {
    if (!first.pair) continue;
    const Receiver& second = (*receivers)[first.second];
    if (!HasFixAt(first, t_ns) || !HasFixAt(second, t_ns)) continue;
    first.file->Append(Hdt(first.pair->Heading_rad(first.last, second.last)));
    first.measured = false;  // prevents a second heading for this time
  }
}

}  // namespace

/// Writes MACHINE/RECEIVER.nmea. Each sample gives GGA and RMC; each fix also gives GST. The first
/// receiver of an antenna pair also gives HDT.
void ExportNmea(ExportJob* job) {
  const std::vector<std::string> paths = job->recording.ChannelsOf(kGnssChannel);
  RequireAny(paths, *job, "GNSS receiver");
  RecordStream stream(job->recording, paths);
  std::vector<Receiver> receivers = OpenReceivers(*job, paths);
  for (Record record; job->Next(&stream, &record);) {
    Receiver& receiver = receivers[record.channel];
    receiver.last = GnssOf(stream, record);
    receiver.measured = true;
    const TimeNs utc_ns = job->Stamp(record.t_ns, kDefaultStart_ns);
    receiver.file->Append(Gga(utc_ns, receiver.last));
    receiver.file->Append(Rmc(utc_ns, receiver.last));
    if (receiver.last.fix != GnssFix::kNone) receiver.file->Append(Gst(utc_ns, receiver.last));
    AppendHeading(record.t_ns, &receivers);
  }
  for (const Receiver& receiver : receivers) receiver.file->Commit();
}

}  // namespace tera
