#include <string_view>

#include "dataset/format/recording.h"
#include "untrusted_file.h"

// A dataset's description and one file of rows, used for all files that it lists. The input is
// dataset.yaml, a 0, the rows.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\0'), size);
  const std::size_t rows = std::min(end + 1, size);
  tera::Put("run/dataset.yaml", data, end);
  for (const char* file : {"run/m/s/data.csv", "run/m/t.csv", "run/truth/m/pose.csv"}) {
    tera::Put(file, data + rows, size - rows);
  }
  tera::Read([] {
    const tera::Recording recording(tera::FuzzFolder() / "run");
    recording.Machines();
    recording.SeriesChannels();
    tera::Read([&] { recording.LoadPose("truth/m/pose.csv"); });
    tera::Read([&] { recording.LoadTable("m/t.csv"); });
    tera::Read([&] { recording.LoadRows("m/s"); });
    tera::Read([&] { recording.LoadImu("m/s"); });
    tera::Read([&] { recording.LoadGnss("m/s"); });
    tera::Read([&] { recording.LoadEncoder("m/s"); });
    tera::Read([&] { recording.FrameTimes("m/s"); });
  });
  return 0;
}
