#include <string_view>

#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/logs/ulog.h"
#include "dataset/import/suggest/suggest.h"
#include "untrusted_file.h"

// Logs of known form: PX4's ULog, RTKLIB's solutions, NMEA 0183, and KITTI's oxts. For oxts the
// input has the timestamps, a 0, and one frame's numbers. The input's first byte chooses the form.

namespace {

namespace fs = std::filesystem;

/// Requests everything in a table.
void AskForAll(const tera::RowTable& table, const std::vector<std::string>& columns) {
  for (const std::string& name : columns) {
    const std::size_t column = table.Column(name);
    for (std::size_t row = 0; row < table.row_count(); ++row) {
      table.NumberIfAny(row, column);
      table.Stamp(row, column);
      if (table.IsPresent(row, column)) tera::Read([&] { table.Number(row, column); });
      if (row > 0) table.Repeats(row, column);
    }
  }
}

void ReadTopics(const fs::path& file) {
  for (const tera::UlogTopic& topic : tera::UlogTopics(file)) {
    std::vector<std::string> paths = topic.fields;
    constexpr std::size_t kMostPaths = 20;
    if (paths.size() > kMostPaths) paths.resize(kMostPaths);
    for (const bool leaves_out : {false, true}) {
      tera::Read([&] {
        tera::LeftOutRows left_out;
        AskForAll(*tera::ReadUlog(file, topic.name, paths, leaves_out ? &left_out : nullptr),
                  paths);
      });
    }
  }
}

void ReadTable(const fs::path& file) {
  for (const bool leaves_out : {false, true}) {
    tera::Read([&] {
      tera::LeftOutRows left_out;
      AskForAll(*tera::ReadLog(file, tera::TypeOfLog(file), leaves_out ? &left_out : nullptr),
                {tera::kLogTimeColumn});
    });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr const char* kNames[] = {"a.ulg", "a.pos", "a.nmea", "oxts/timestamps.txt"};
  const std::size_t form = data[0] % 4;
  const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  const std::size_t end = form == 3 ? std::min(text.find('\0'), text.size()) : text.size();
  if (form == 3) {
    const std::size_t frame = std::min(end + 1, text.size());
    tera::Put("oxts/data/0000000000.txt", data + 1 + frame, text.size() - frame);
  }
  tera::ReadAsFile(kNames[form], data + 1, end, form == 0 ? ReadTopics : ReadTable);
  tera::Read([&] { tera::SuggestMapping(tera::FuzzFolder() / kNames[form]); });
  return 0;
}
