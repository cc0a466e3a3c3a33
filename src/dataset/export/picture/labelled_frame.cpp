#include "dataset/export/picture/labelled_frame.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "core/beside.h"
#include "core/error.h"
#include "core/types/labels.h"
#include "dataset/export/record_stream.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/object_boxes.h"
#include "dataset/format/png.h"
#include "dataset/format/png_rows.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kPngStart("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", 16);

[[noreturn]] void FailPng(const fs::path& file) {
  throw InputError(file.string(),
                   {FaultKind::kMalformed, "not a whole PNG; need one, write the file again"});
}

/// True if all chunks from IHDR to IEND have valid lengths and checksums.
bool HasWholeChunks(std::string_view png) {
  constexpr std::size_t kSignatureBytes = 8, kAround = 12;  // length, name and checksum of a chunk
  for (std::size_t at = kSignatureBytes; png.size() - at >= kAround;) {
    const std::size_t length = PngNumberAt(png, at);
    if (length > png.size() - at - kAround) return false;
    const std::string_view summed = png.substr(at + 4, 4 + length);
    const std::uint32_t sum = libdeflate_crc32(0, summed.data(), summed.size());
    at += kAround + length;
    if (PngNumberAt(png, at - 4) != sum) return false;
    if (summed.starts_with("IEND")) return at == png.size();
  }
  return false;
}

void RequireKnownClasses(const Image<std::uint8_t>& semantic, const fs::path& file) {
  const auto highest = std::max_element(semantic.data.begin(), semantic.data.end());
  if (highest == semantic.data.end() || *highest < kSemanticClasses.size()) return;
  throw InputError(
      file.string(),
      {FaultKind::kNoSuchName,
       fmt::format("has the class {}; need classes of docs/reference/dataset.md, 0 to {}", *highest,
                   kSemanticClasses.size() - 1)});
}

}  // namespace

bool IsThere(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

fs::path FrameFile(const Recording& recording, const std::string& camera, std::string_view kind,
                   TimeNs t_ns) {
  return recording.directory() / camera / kind /
         fmt::format("{}.{}", t_ns, kind == "boxes" ? "json" : "png");
}

std::vector<std::string> CamerasWith(const Recording& recording,
                                     const std::vector<std::string_view>& kinds) {
  std::vector<std::string> cameras = recording.SensorsOf(ChannelForm::kPictures);
  std::erase_if(cameras, [&](const std::string& camera) {
    RecordStream stream(recording, std::vector<std::string>{camera});
    Record first;
    return !stream.Next(&first) ||
           !std::all_of(kinds.begin(), kinds.end(), [&](std::string_view kind) {
             return IsThere(FrameFile(recording, camera, kind, first.t_ns));
           });
  });
  return cameras;
}

LabelledFrame LoadLabels(const Recording& recording, const std::string& camera, TimeNs t_ns) {
  LabelledFrame frame;
  frame.t_ns = t_ns;
  const fs::path semantic = FrameFile(recording, camera, "semantic", t_ns);
  const fs::path instance = FrameFile(recording, camera, "instance", t_ns);
  const fs::path boxes = FrameFile(recording, camera, "boxes", t_ns);
  PreparePng();
  auto instances = Beside([&] { return ReadGrey16Png(instance); });
  frame.semantic = ReadGreyPng(semantic);
  frame.instance = instances.get();
  if (frame.semantic.width_px != frame.instance.width_px ||
      frame.semantic.height_px != frame.instance.height_px) {
    throw InputError(
        instance.string(),
        fmt::format("has another size than {}; need one size for a frame", semantic.string()));
  }
  RequireKnownClasses(frame.semantic, semantic);
  if (IsThere(boxes)) frame.boxes = ReadBoxes(boxes);
  return frame;
}

PictureSize SizeOfPng(const fs::path& file) {
  std::array<char, 24> header{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(header.data(), header.size());
  const std::string_view bytes(header.data(), header.size());
  if (!stream || !bytes.starts_with(kPngStart)) FailPng(file);
  return {static_cast<int>(PngNumberAt(bytes, 16)), static_cast<int>(PngNumberAt(bytes, 20))};
}

std::string ReadWholePng(const fs::path& file) {
  std::string bytes = ReadWholeFile(file);
  if (!bytes.starts_with(kPngStart) || !HasWholeChunks(bytes)) FailPng(file);
  return bytes;
}

}  // namespace tera
