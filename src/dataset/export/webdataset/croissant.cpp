#include <fmt/format.h>

#include <string>
#include <vector>

#include "dataset/export/json_lists.h"
#include "dataset/export/webdataset/dataset_card.h"
#include "dataset/files/file_digest.h"
#include "dataset/format/dataset_description.h"

namespace tera {
namespace {

/// The JSON-LD context that the specification prescribes.
OrderedJson Context() {
  OrderedJson context = {{"@language", "en"},
                         {"@vocab", "https://schema.org/"},
                         {"sc", "https://schema.org/"},
                         {"cr", "http://mlcommons.org/croissant/"},
                         {"dct", "http://purl.org/dc/terms/"},
                         {"conformsTo", "dct:conformsTo"},
                         {"data", {{"@id", "cr:data"}, {"@type", "@json"}}},
                         {"examples", {{"@id", "cr:examples"}, {"@type", "@json"}}},
                         {"dataType", {{"@id", "cr:dataType"}, {"@type", "@vocab"}}}};
  for (const char* term :
       {"arrayShape", "citeAs",   "column",      "containedIn",   "equivalentProperty",
        "extract",    "field",    "fileObject",  "fileProperty",  "fileSet",
        "format",     "includes", "isArray",     "isLiveDataset", "jsonPath",
        "key",        "md5",      "parentField", "path",          "recordSet",
        "references", "regex",    "repeated",    "replace",       "samplingRate",
        "separator",  "source",   "subField",    "transform"}) {
    context[term] = std::string("cr:") + term;
  }
  return context;
}

OrderedJson Reference(const std::string& id) { return {{"@id", id}}; }

std::string EncodingOf(const std::string& ending) {
  if (ending.ends_with("png")) return "image/png";
  return ending.ends_with("json") ? "application/json" : "application/octet-stream";
}

/// Identifier of the files with one ending, such as "excavator1_front/rgb.png".
std::string PartId(const SensorArchives& sensor, const std::string& ending) {
  return sensor.name + "/" + ending;
}

void AddFiles(const std::filesystem::path& folder, const SensorArchives& sensor,
              OrderedJson* distribution) {
  OrderedJson within = OrderedJson::array();
  for (const SensorArchives::Archive& archive : sensor.archives) {
    within.push_back(Reference(archive.file));
    distribution->push_back({{"@type", "cr:FileObject"},
                             {"@id", archive.file},
                             {"name", archive.file},
                             {"contentUrl", archive.file},
                             {"contentSize", fmt::format("{} B", archive.bytes)},
                             {"encodingFormat", "application/x-tar"},
                             {"sha256", DigestOf(folder / archive.file).sha256}});
  }
  for (const std::string& ending : sensor.endings) {
    distribution->push_back({{"@type", "cr:FileSet"},
                             {"@id", PartId(sensor, ending)},
                             {"name", PartId(sensor, ending)},
                             {"containedIn", within},
                             {"encodingFormat", EncodingOf(ending)},
                             {"includes", fmt::format("{}/*.{}", sensor.name, ending)}});
  }
}

/// One record per file with this ending: its sample and its content.
OrderedJson Records(const SensorArchives& sensor, const std::string& ending) {
  const std::string set = PartId(sensor, ending), id = set + "/records";
  const OrderedJson key = {
      {"fileSet", Reference(set)},
      {"extract", {{"fileProperty", "fullpath"}}},
      {"transform", {{"regex", fmt::format("({}/[-_0-9]+)\\.", sensor.name)}}}};
  const OrderedJson content = {{"fileSet", Reference(set)},
                               {"extract", {{"fileProperty", "content"}}}};
  const char* const type = ending.ends_with("png") ? "sc:ImageObject" : "sc:Text";
  OrderedJson fields = OrderedJson::array();
  fields.push_back({{"@type", "cr:Field"},
                    {"@id", id + "/key"},
                    {"name", "key"},
                    {"dataType", "sc:Text"},
                    {"source", key}});
  fields.push_back({{"@type", "cr:Field"},
                    {"@id", id + "/content"},
                    {"name", "content"},
                    {"dataType", type},
                    {"source", content}});
  return {{"@type", "cr:RecordSet"},
          {"@id", id},
          {"name", id},
          {"key", Reference(id + "/key")},
          {"field", fields}};
}

}  // namespace

std::string CroissantJson(const std::filesystem::path& folder, const DatasetInfo& info,
                          const CardFacts& facts, const std::vector<SensorArchives>& sensors) {
  OrderedJson distribution = OrderedJson::array(), records = OrderedJson::array();
  for (const SensorArchives& sensor : sensors) {
    AddFiles(folder, sensor, &distribution);
    for (const std::string& ending : sensor.endings) {
      if (EncodingOf(ending) != "application/octet-stream") {
        records.push_back(Records(sensor, ending));
      }
    }
  }
  const char* const creator = facts.creator_is_person ? "sc:Person" : "sc:Organization";
  return OrderedJson{{"@context", Context()},
                     {"@type", "sc:Dataset"},
                     {"conformsTo", "http://mlcommons.org/croissant/1.1"},
                     {"name", info.scenario_name},
                     {"description", facts.description},
                     {"license", facts.license},
                     {"url", facts.url},
                     {"datePublished", facts.date_published},
                     {"creator", {{"@type", creator}, {"name", facts.creator}}},
                     {"version", facts.version},
                     {"distribution", distribution},
                     {"recordSet", records}}
             .dump(1) +
         "\n";
}

}  // namespace tera
