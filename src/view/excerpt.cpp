#include "view/excerpt.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "view/excerpt_parts.h"
#include "view/page.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostRows = 2000;  ///< rows per table
constexpr std::size_t kRarest = 1000;    ///< largest n of every n-th frame
constexpr double kBytesPerMb = 1e6;
constexpr std::uint64_t kHead = 1 << 12;  ///< bytes of text besides index and files
constexpr std::uint64_t kPlace = 48;  ///< bytes of a file's entry in the table of contents, besides
                                      ///< its name

std::string Base64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto at = [&](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned word = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    const std::array<int, 4> shifts = {18, 12, 6, 0};
    for (std::size_t d = 0; d < shifts.size(); ++d) {
      text += i + d > bytes.size() ? '=' : kDigits[word >> shifts[d] & 63];
    }
  }
  return text;
}

/// Embedded files by the name in their request. "0/path" is a file of the first item.
class Pack {
 public:
  void Add(const std::string& name, const std::string& bytes) {
    places_[name] = {bytes_.size(), bytes.size()};
    bytes_ += bytes;
  }
  std::size_t size() const { return bytes_.size(); }
  const Json& places() const { return places_; }
  const std::string& bytes() const { return bytes_; }

 private:
  Json places_ = Json::object();
  std::string bytes_;
};

/// Content of one dataset or diagnosis in the page.
struct Part {
  const Viewed* viewed;
  Json index;
  std::vector<FrameList> frames;
};

void AddTables(const std::string& prefix, Part* part, Pack* pack) {
  for (Json& channel : part->index["channels"]) {
    if (channel["form"] != "rows") continue;
    const std::string file = channel["file"];
    const std::string thin = ThinnedTable(part->viewed->folder.Read(file), kMostRows);
    channel["bytes"] = thin.size();
    pack->Add(prefix + file, thin);
  }
}

/// Adds only the first and the last ground, because all grounds would fill the page.
void AddGrounds(const std::string& prefix, Part* part, Pack* pack) {
  Json kept = Json::array();
  for (const std::string name : part->index["terrain"]) {
    if (name != "height_start.tif" && name != "height_end.tif") continue;
    kept.push_back(name);
    const std::string file = "truth/terrain/" + name;
    pack->Add(prefix + file, part->viewed->folder.Read(file));
  }
  part->index["terrain"] = kept;
}

void AddFilesOfDiagnosis(const std::string& prefix, const Part& part, Pack* pack) {
  for (const char* list : {"grounds", "series"}) {
    for (const auto& [name, bytes] : part.index[list].items()) {
      pack->Add(prefix + name, part.viewed->folder.Read(name));
    }
  }
}

void AddStage(const std::string& prefix, const Viewed& viewed, Pack* pack) {
  if (!viewed.stage) return;
  try {
    pack->Add(prefix + "stage", viewed.stage());
  } catch (const InputError& e) {
    pack->Add(prefix + "stage.error", e.what());
  }
}

Part Open(const std::string& prefix, const Viewed& viewed, Pack* pack) {
  Part part{.viewed = &viewed, .index = Json::parse(viewed.index_json), .frames = {}};
  if (viewed.kind == Viewed::Kind::kDiagnosis) {
    AddFilesOfDiagnosis(prefix, part, pack);
    return part;
  }
  AddTables(prefix, &part, pack);
  AddGrounds(prefix, &part, pack);
  AddStage(prefix, viewed, pack);
  for (const Json& channel : part.index["channels"]) {
    if (channel["form"] == "rows") continue;
    part.frames.emplace_back(viewed.folder, channel["path"].get<std::string>(),
                             channel.value("pictures", std::vector<std::string>()));
  }
  return part;
}

std::uint64_t BytesOfFrames(const std::vector<Part>& parts, std::size_t n) {
  std::uint64_t sum = 0;
  for (const Part& part : parts) {
    for (const FrameList& frames : part.frames) sum += frames.Bytes(n) + frames.Table(n).size();
  }
  return sum;
}

/// Bytes of the table of contents for every n-th frame.
std::uint64_t BytesOfPlaces(const std::vector<Part>& parts, std::size_t n) {
  std::uint64_t sum = 0;
  for (const Part& part : parts) {
    for (const FrameList& frames : part.frames) {
      for (const std::string& file : frames.Files(n)) sum += file.size() + kPlace;
    }
  }
  return sum;
}

/// The smallest n for which every n-th frame fits.
std::size_t Spread(const std::vector<Part>& parts, std::uint64_t base, std::uint64_t most) {
  const auto page = [&](std::size_t n) {
    return base + BytesOfPlaces(parts, n) + (BytesOfFrames(parts, n) + 2) / 3 * 4;
  };
  for (std::size_t n = 1; n <= kRarest; ++n) {
    if (page(n) <= most) return n;
  }
  throw InputError("--size", {FaultKind::kOutOfRange,
                              fmt::format("{:.0f} MB are too few: with every thousandth frame "
                                          "alone the page has {:.1f} MB; give more",
                                          static_cast<double>(most) / kBytesPerMb,
                                          static_cast<double>(page(kRarest)) / kBytesPerMb)});
}

void AddFrames(const std::string& prefix, const Part& part, std::size_t n, Pack* pack) {
  if (part.viewed->kind == Viewed::Kind::kDiagnosis) return;
  std::size_t next = 0;
  for (const Json& channel : part.index["channels"]) {
    if (channel["form"] == "rows") continue;
    const FrameList& frames = part.frames[next++];
    pack->Add(prefix + channel["file"].get<std::string>(), frames.Table(n));
    for (const std::string& file : frames.Files(n)) {
      pack->Add(prefix + file, part.viewed->folder.Read(file));
    }
  }
}

/// JSON escaped for use in a script element.
std::string InScript(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

std::string WordsOf(const std::vector<Part>& parts, std::size_t n) {
  std::size_t all = 0, kept = 0;
  for (const Part& part : parts) {
    for (const FrameList& frames : part.frames) {
      all += frames.size();
      kept += (frames.size() + n - 1) / n;
    }
  }
  return fmt::format("An excerpt: {} of {} frames (every {}), at most {} rows of each table", kept,
                     all,
                     n == 1   ? "one"
                     : n == 2 ? "second"
                              : fmt::format("{}th", n),
                     kMostRows);
}

}  // namespace

Excerpt MakeExcerpt(const std::vector<Viewed>& viewed, const std::string& page,
                    std::uint64_t most_bytes) {
  Pack pack;
  std::vector<Part> parts;
  for (std::size_t k = 0; k < viewed.size(); ++k) {
    parts.push_back(Open(std::to_string(k) + "/", viewed[k], &pack));
  }
  std::uint64_t index = kHead;
  for (const Part& part : parts) index += part.index.dump().size();
  for (const auto& [name, place] : pack.places().items()) index += name.size() + kPlace;
  const std::size_t n = Spread(parts, page.size() + index + pack.size() / 3 * 4, most_bytes);
  std::vector<Viewed> indexed = viewed;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    AddFrames(std::to_string(k) + "/", parts[k], n, &pack);
    indexed[k].index_json = parts[k].index.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  Excerpt excerpt{.html = page, .words = WordsOf(parts, n)};
  const Json head = {{"index", Json::parse(IndexJson(indexed, excerpt.words))},
                     {"places", pack.places()}};
  const std::string data = fmt::format(
      "<script type=\"application/json\" id=\"pack-head\">{}</script>\n"
      "<script type=\"text/plain\" id=\"pack-bytes\">{}</script>",
      InScript(head), Base64(pack.bytes()));
  excerpt.html.replace(excerpt.html.find(kPackMark), kPackMark.size(), data);
  return excerpt;
}

}  // namespace tera
