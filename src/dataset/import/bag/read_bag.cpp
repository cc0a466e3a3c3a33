#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/config/config.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/bag/bag_file.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/bag/unpack.h"
#include "dataset/import/bag/unpacked_file.h"
#include "dataset/import/foreign_file.h"

namespace tera {
namespace {

namespace fs = std::filesystem;

/// Renumbers the topics of several files, so that their numbers differ.
class Renumbered : public BagVisitor {
 public:
  explicit Renumbered(BagVisitor* visitor) : visitor_(visitor) {}

  void NextFile() { before_ = asked_; }
  Wish Wants(const BagTopic& topic) override {
    ++asked_;
    return visitor_->Wants(topic);
  }
  bool Take(std::size_t number, const BagMessage& message) override {
    return visitor_->Take(before_ + number, message);
  }

 private:
  BagVisitor* visitor_;
  std::size_t asked_ = 0, before_ = 0;
};

/// First bytes of a file, by which its format is recognised.
std::string FirstBytes(const fs::path& file) {
  constexpr std::uint64_t kMagicBytes = 7;
  BagFile bytes(file);
  return bytes.Read(0, std::min(bytes.size(), kMagicBytes));
}

using FileReader = bool (*)(const fs::path& file, BagVisitor* visitor, bool to_the_damage);

/// Reader for a file with these first bytes; null if it is not a bag.
FileReader ReaderOf(std::string_view first) {
  if (first.starts_with("\x89MCAP")) {
    return
        [](const fs::path& file, BagVisitor* visitor, bool) { return ReadMcapFile(file, visitor); };
  }
  if (first.starts_with("#ROSBAG")) {
    return [](const fs::path& file, BagVisitor* visitor, bool) {
      return ReadRos1BagFile(file, visitor);
    };
  }
  if (first.starts_with("SQLite ")) return ReadSqliteBagFile;
  return nullptr;
}

bool ReadPlainFile(const fs::path& file, BagVisitor* visitor, bool to_the_damage) {
  if (const FileReader read = ReaderOf(FirstBytes(file))) {
    return read(file, visitor, to_the_damage);
  }
  RefuseForeignFile(file, "an MCAP file, a SQLite 3 file of rosbag2 or a ROS 1 bag");
  throw InputError(file.string() +
                   ": is not a bag; need an MCAP file, a SQLite 3 file of rosbag2 or a ROS 1 bag; "
                   "a text table has no 'topic'");
}

bool ReadPackedFile(const fs::path& packed, const UnpackedFile& file, BagVisitor* visitor,
                    bool to_the_damage) {
  const auto told = [&](const std::string& damage) {
    return BagDamage(
        fmt::format("{}: {}; copy the file again, or read the part before with --skip-bad-rows",
                    packed.string(), damage));
  };
  if (file.damage() && !to_the_damage) throw told(*file.damage());
  try {
    if (!ReadPlainFile(file.path(), visitor, to_the_damage)) return false;
  } catch (const BagDamage& fault) {
    throw BagDamage(file.OfPacked(fault.what()));
  } catch (const InputError& fault) {
    if (file.damage()) throw told(*file.damage());
    throw InputError(file.OfPacked(fault.what()));
  }
  if (file.damage()) throw told(*file.damage());
  return true;
}

bool ReadFile(const fs::path& file, UnpackedFiles* unpacked, BagVisitor* visitor,
              bool to_the_damage) {
  // The content decides, because a compressed file may have any name.
  if (!IsZstdFrame(FirstBytes(file))) return ReadPlainFile(file, visitor, to_the_damage);
  return ReadPackedFile(file, unpacked->Of(file), visitor, to_the_damage);
}

/// Files listed in the metadata.yaml of a rosbag2 folder.
std::vector<fs::path> FilesOf(const fs::path& metadata) {
  // Finish is not called: it would report keys that differ between versions of the recorder.
  const Config config = Config::FromFile(metadata);
  const auto bag = config.root().OptionalMap("rosbag2_bagfile_information");
  std::vector<fs::path> files;
  if (bag && bag->IsList("relative_file_paths")) {
    for (const std::string& name : bag->Texts("relative_file_paths")) {
      // Early versions wrote the name of the folder in front of the file name.
      files.push_back(metadata.parent_path() / fs::path(name).filename());
    }
  }
  if (files.empty()) {
    throw InputError(metadata.string() +
                     ": names no relative_file_paths in rosbag2_bagfile_information; need the "
                     "metadata.yaml of a rosbag2, or name the bag's file itself");
  }
  return files;
}

}  // namespace

bool LooksLikeBag(const fs::path& file) {
  const bool is_packed = file.extension() == ".zstd" || file.extension() == ".zst";
  const fs::path name = is_packed ? file.stem() : file.filename();
  const std::string ending = name.extension();
  if (ending == ".mcap" || ending == ".db3" || ending == ".bag" ||
      file.filename() == kBagMetadata || fs::is_regular_file(file / kBagMetadata)) {
    return true;
  }
  if (!fs::is_regular_file(file)) return false;
  const std::string first = FirstBytes(file);
  return IsZstdFrame(first) || ReaderOf(first) != nullptr;
}

std::vector<fs::path> FilesOfBag(const fs::path& bag) {
  if (fs::is_directory(bag)) return FilesOf(bag / kBagMetadata);
  if (bag.filename() == kBagMetadata) return FilesOf(bag);
  return {bag};
}

void ReadBag(const fs::path& bag, UnpackedFiles* unpacked, BagVisitor* visitor,
             bool to_the_damage) {
  Renumbered numbered(visitor);
  std::optional<BagDamage> damage;
  for (const fs::path& file : FilesOfBag(bag)) {
    numbered.NextFile();
    try {
      if (!ReadFile(file, unpacked, &numbered, to_the_damage)) return;
    } catch (const BagDamage& found) {
      if (!to_the_damage) throw;
      // Later files may be undamaged.
      if (!damage) damage = found;
    }
  }
  if (damage) throw BagDamage(*damage);
}

std::string ShortTypeName(std::string_view type) {
  constexpr std::string_view kFolder = "/msg/";
  const std::size_t at = type.find(kFolder);
  if (at == std::string_view::npos) return std::string(type);
  return std::string(type.substr(0, at + 1)) + std::string(type.substr(at + kFolder.size()));
}

}  // namespace tera
