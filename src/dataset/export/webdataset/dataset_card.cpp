#include "dataset/export/webdataset/dataset_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/config/config.h"
#include "core/types/labels.h"
#include "dataset/format/dataset_description.h"

namespace tera {
namespace {

bool IsDate(const std::string& text) {
  constexpr std::string_view kForm = "dddd-dd-dd";
  return text.size() == kForm.size() &&
         std::equal(text.begin(), text.end(), kForm.begin(), [](char c, char form) {
           return form == 'd' ? std::isdigit(static_cast<unsigned char>(c)) != 0 : c == form;
         });
}

bool IsUrl(const std::string& text) {
  return text.starts_with("https://") || text.starts_with("http://");
}

std::int64_t SamplesOf(const SensorArchives& sensor) {
  std::int64_t samples = 0;
  for (const SensorArchives::Archive& archive : sensor.archives) samples += archive.samples;
  return samples;
}

/// Metadata for the Hugging Face Hub, with one configuration per sensor.
std::string FrontMatter(const DatasetInfo& info, const CardFacts& facts,
                        const std::vector<SensorArchives>& sensors) {
  std::string text = fmt::format(
      "---\npretty_name: {}\nlicense: other\nlicense_name: see-link\nlicense_link: {}\n"
      "tags: [webdataset{}]\nconfigs:\n",
      YamlQuoted(info.scenario_name), YamlQuoted(facts.license),
      info.simulated ? ", synthetic" : "");
  for (const SensorArchives& sensor : sensors) {
    text += fmt::format("  - config_name: {0}\n    data_files: \"{0}-*.tar\"\n", sensor.name);
  }
  return text + "---\n";
}

std::string Origin(const DatasetInfo& info) {
  if (!info.simulated) return "A recording of reality.";
  return fmt::format(
      "Simulated by TERA {}, scenario `{}`, seed {}; the same scenario and seed give "
      "the same data.",
      TeraVersion(), info.scenario_name, info.seed);
}

}  // namespace

CardFacts ReadCardFacts(const std::filesystem::path& file) {
  const Config config = Config::FromFile(file);
  const ConfigMap root = config.root();
  CardFacts facts;
  facts.description = root.Text("description");
  facts.license = root.Text("license");
  facts.url = root.Text("url");
  facts.date_published = root.Text("date_published");
  facts.version = root.Text("version", "1.0.0");
  facts.creator_is_person = root.Has("person");
  if (root.Has("person") && root.Has("organization")) {
    root.Fault("person", "given beside organization; keep the creator of the data");
  }
  facts.creator = facts.creator_is_person ? root.Text("person") : root.Text("organization");
  if (root.Has("license") && !IsUrl(facts.license)) {
    root.Fault("license",
               {FaultKind::kMistyped, "need a URL, such as one of https://spdx.org/licenses/"});
  }
  if (root.Has("url") && !IsUrl(facts.url))
    root.Fault("url", {FaultKind::kMistyped, "need a URL, of the data's page"});
  if (root.Has("date_published") && !IsDate(facts.date_published)) {
    root.Fault("date_published", {FaultKind::kMistyped, "need a date, 2026-05-01"});
  }
  config.Finish();
  return facts;
}

std::string CardText(const DatasetInfo& info, const CardFacts& facts,
                     const std::vector<SensorArchives>& sensors) {
  std::string text = FrontMatter(info, facts, sensors);
  text += fmt::format("# {}\n\n{}\n\n{}\n\n", info.scenario_name, facts.description, Origin(info));
  text += fmt::format("By {}, {}. Licence: {}. Metadata: croissant.json (Croissant 1.1).\n\n",
                      facts.creator, facts.date_published, facts.license);
  text += "| sensor | samples | archives | parts |\n| --- | --- | --- | --- |\n";
  for (const SensorArchives& sensor : sensors) {
    std::string parts;
    for (const std::string& ending : sensor.endings) {
      parts += (parts.empty() ? "" : ", ") + ending;
    }
    text += fmt::format("| `{}` | {} | {} | {} |\n", sensor.name, SamplesOf(sensor),
                        sensor.archives.size(), parts);
  }
  text +=
      "\nDepth is in millimetres, 0 where there is none; `json` has the time, boxes and, where it "
      "was recorded, the true place of the sensor. `*.sensor.yaml` is the sensor's model.\n\n"
      "Classes: ";
  for (const SemanticClassInfo& label : kSemanticClasses) {
    text += fmt::format("{}{} {}", label.label == SemanticClass::kSky ? "" : ", ",
                        static_cast<int>(label.label), label.name);
  }
  return text + ".\n";
}

}  // namespace tera
