#include "dataset/realism/realism.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "dataset/format/recording.h"
#include "dataset/realism/realism_sums.h"

namespace tera {

Realism MeasureRealism(const std::filesystem::path& dataset, int every_frame) {
  const Recording recording(dataset);
  RealismSums sums;
  for (const std::string& folder : recording.SensorsOf(ChannelForm::kPictures)) {
    const std::vector<TimeNs> times = recording.FrameTimes(folder);
    for (std::size_t k = 0; k < times.size(); k += static_cast<std::size_t>(every_frame)) {
      const CameraFrame frame = recording.LoadFrame(folder, times[k]);
      if (frame.rgb.empty()) break;
      sums.Add(dataset / folder, frame);
    }
  }
  if (sums.pictures() == 0) {
    throw InputError(dataset.string(), {FaultKind::kMissing,
                                        "holds no colour pictures; need a camera with rgb: true"});
  }
  return sums.Told();
}

std::string RealismTable(const Realism& r) {
  std::string table =
      fmt::format("{} pictures\n\n{:<22} {:<24} photographs\n", r.pictures, "", "this dataset");
  table += fmt::format(
      "{:<22} {:<24} {}\n", "amplitude slope",
      fmt::format("{:.2f} ({:.2f} to {:.2f})", r.slope_mean, r.slope_least, r.slope_most),
      "-1.2 (-1.5 to -0.8), Tolhurst et al. 1992");
  table += fmt::format(
      "{:<22} {:<24} {}\n", "colourfulness", fmt::format("{:.1f}", r.colourfulness),
      "0 grey, 15 slight, 33 moderate, 45 average, 59 quite, Hasler and Suesstrunk 2003");
  table += fmt::format("\n{:<16} {:>10} {:>11} {:>18} {:>12} {:>9}\n", "class", "pixels",
                       "MSCN shape", "gradient kurtosis", "chroma C*ab", "noise DN");
  for (const SurfaceRealism& s : r.surfaces) {
    table += fmt::format("{:<16} {:>10} {:>11.2f} {:>18.1f} {:>12.1f} {:>9.2f}\n", s.name, s.pixels,
                         s.mscn_shape, s.gradient_kurtosis, s.chroma, s.noise_dn);
  }
  table += fmt::format("{:<16} {:>10} {:>11} {:>18} {:>12} {:>9}\n", "photographs", "", "near 2",
                       "about 17", "-", "-");
  table += "  MSCN: near a Gaussian's 2, Ruderman 1994; gradient: Huang and Mumford 1999\n";
  return table;
}

std::string RealismJson(const Realism& r) {
  nlohmann::ordered_json json = {
      {"pictures", r.pictures},
      {"amplitude_slope",
       {{"mean", r.slope_mean}, {"least", r.slope_least}, {"most", r.slope_most}}},
      {"colourfulness", r.colourfulness},
      {"surfaces", nlohmann::ordered_json::array()}};
  for (const SurfaceRealism& s : r.surfaces) {
    json["surfaces"].push_back({{"class", s.name},
                                {"pixels", s.pixels},
                                {"mscn_shape", s.mscn_shape},
                                {"gradient_kurtosis", s.gradient_kurtosis},
                                {"chroma_cab", s.chroma},
                                {"noise_dn", s.noise_dn}});
  }
  return json.dump(2) + "\n";
}

}  // namespace tera
