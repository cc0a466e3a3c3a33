#include "dataset/format/series_tables.h"

namespace tera {

std::vector<std::string> SeriesTables(const Recording& recording) {
  std::vector<std::string> tables = recording.ChannelsOf(kTableChannel);
  std::erase_if(tables, [](const std::string& path) {
    return path.starts_with("truth/") || path.ends_with("/commands.csv");
  });
  return tables;
}

}  // namespace tera
