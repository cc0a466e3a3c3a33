#include "dataset/format/dataset_description.h"

#include <fmt/format.h>

#include <iterator>

namespace tera {

std::string_view TeraVersion() { return TERA_VERSION; }

std::string YamlQuoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (code < 0x20) {
      quoted += fmt::format("\\x{:02x}", code);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string InputsYaml(const std::vector<RecordedInput>& inputs) {
  std::string text = inputs.empty() ? "inputs: []\n" : "inputs:\n";
  for (const RecordedInput& input : inputs) {
    fmt::format_to(std::back_inserter(text), "  - {{file: {}, bytes: {}, sha256: {}}}\n",
                   YamlQuoted(input.name), input.bytes, YamlQuoted(input.sha256));
  }
  return text;
}

std::string DatasetYaml(const DatasetInfo& info, const std::vector<ChannelDescription>& channels) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "format: {}\ntera_version: {}\n", kDatasetFormat, YamlQuoted(TERA_VERSION));
  fmt::format_to(out, "name: {}\nsimulated: {}\nseed: {}\nduration_s: {}\n",
                 YamlQuoted(info.scenario_name), info.simulated, info.seed, info.duration_s);
  fmt::format_to(out, "origin: {{lat_deg: {}, lon_deg: {}, height_m: {}}}\n", info.origin_lat_deg,
                 info.origin_lon_deg, info.origin_height_m);
  if (info.epoch) text += EpochYaml(*info.epoch);
  fmt::format_to(out, "channels:{}\n", channels.empty() ? " []" : "");
  for (const ChannelDescription& channel : channels) {
    fmt::format_to(out, "  - {{path: {}, type: {}}}\n", YamlQuoted(channel.path), channel.type);
  }
  fmt::format_to(out, "classes:\n");
  for (const SemanticClassInfo& info : kSemanticClasses) {
    fmt::format_to(out, "  - {{id: {}, name: {}}}\n", static_cast<int>(info.label), info.name);
  }
  fmt::format_to(out, "instances:{}\n", info.instances.empty() ? " []" : "");
  for (const DatasetInfo::Instance& instance : info.instances) {
    const std::string parent =
        instance.parent != 0 ? fmt::format(", parent: {}", instance.parent) : "";
    fmt::format_to(out, "  - {{id: {}, name: {}, class: {}{}}}\n", instance.id,
                   YamlQuoted(instance.name), instance.label, parent);
  }
  return text + InputsYaml(info.inputs);
}

}  // namespace tera
