#include <sstream>

#include "view/excerpt_parts.h"

namespace tera {
namespace {

/// The stamp at the beginning of a row.
std::string StampOf(const std::string& line) { return line.substr(0, line.find(',')); }

std::vector<std::string> NamesOf(const std::string& channel, const std::string& line,
                                 const std::vector<std::string>& pictures) {
  if (pictures.empty()) return {channel + "/scans/" + StampOf(line) + ".pcd"};
  std::vector<std::string> names = {channel + "/boxes/" + StampOf(line) + ".json"};
  for (const std::string& kind : pictures) {
    names.push_back(channel + "/" + kind + "/" + StampOf(line) + ".png");
  }
  return names;
}

}  // namespace

FrameList::FrameList(const ServedFolder& folder, const std::string& channel,
                     const std::vector<std::string>& pictures) {
  std::istringstream table(folder.Read(channel + "/data.csv"));
  std::getline(table, head_);
  for (std::string line; std::getline(table, line);) {
    if (line.empty()) continue;
    Row row{.line = line, .files = {}};
    for (const std::string& name : NamesOf(channel, line, pictures)) {
      const auto file = folder.Find(name);
      if (!file) continue;
      row.files.push_back(name);
      row.bytes += std::filesystem::file_size(*file);
    }
    rows_.push_back(std::move(row));
  }
}

std::string FrameList::Table(std::size_t n) const {
  std::string text = head_ + "\n";
  for (std::size_t k = 0; k < rows_.size(); k += n) text += rows_[k].line + "\n";
  return text;
}

std::vector<std::string> FrameList::Files(std::size_t n) const {
  std::vector<std::string> files;
  for (std::size_t k = 0; k < rows_.size(); k += n) {
    files.insert(files.end(), rows_[k].files.begin(), rows_[k].files.end());
  }
  return files;
}

std::uint64_t FrameList::Bytes(std::size_t n) const {
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < rows_.size(); k += n) sum += rows_[k].bytes;
  return sum;
}

}  // namespace tera
