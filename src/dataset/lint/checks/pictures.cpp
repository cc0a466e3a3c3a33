#include <fmt/format.h>

#include <filesystem>

#include "core/error.h"
#include "core/types/label_channels.h"
#include "dataset/format/object_boxes.h"
#include "dataset/format/png.h"
#include "dataset/lint/checks/picture_set.h"

// Checks the images of cameras. Memory holds one frame.

namespace tera {
namespace fs = std::filesystem;
namespace {

using PictureSize = std::optional<std::pair<int, int>>;

const FrameFolder kBoxes = {"boxes", "json"};

/// Runs `read`. If it fails, adds a finding and returns false.
bool Reads(LintJob* job, RuleId rule, const PictureSet& set, const FrameFolder& folder,
           const std::function<void()>& read) {
  job->Applies(rule);
  try {
    read();
    return true;
  } catch (const InternalError&) {
    throw;
  } catch (const std::exception& e) {  // OpenCV throws exceptions of its own for some headers
    job->Find(rule, set.camera, set.In(folder, e.what()));
    return false;
  }
}

/// Reports an image that does not have the camera's size, and clears it.
template <typename T>
void HoldToSize(LintJob* job, const PictureSet& set, const FrameFolder& folder, PictureSize* size,
                Image<T>* picture) {
  job->Applies("pictures.size");
  const std::pair<int, int> found{picture->width_px, picture->height_px};
  if (!*size) *size = found;
  if (found == **size) return;
  job->Find("pictures.size", set.camera,
            set.In(folder, fmt::format("has {} x {} pixels, need {} x {}", found.first,
                                       found.second, (*size)->first, (*size)->second)));
  *picture = Image<T>();
}

template <typename T, typename Read>
void ReadOne(LintJob* job, const PictureSet& set, const FrameFolder& folder, PictureSize* size,
             Image<T>* picture, const Read& read) {
  const fs::path file = job->Path(FrameFile(set.camera, folder, set.row.t_ns));
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return;  // reported by files.missing
  ++job->statistics().pictures;
  if (Reads(job, "pictures.readable", set, folder, [&] { read(file, picture); })) {
    HoldToSize(job, set, folder, size, picture);
  } else {
    *picture = Image<T>();
  }
}

void CheckPicturesOf(LintJob* job, const std::string& camera) {
  const std::vector<FrameRow> frames = FramesOf(*job, camera);
  const std::vector<FrameFolder> folders = UsedPictureFolders(*job, camera);
  const std::optional<SensorSheet> sheet = job->SheetOf(camera);
  PictureSize size;
  if (sheet && sheet->lens) size = {sheet->lens->width_px, sheet->lens->height_px};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i % static_cast<std::size_t>(job->options().every_frame) != 0) continue;
    PictureSet set = ReadPictures(job, camera, frames[i], folders, &size);
    set.is_first = i == 0;
    CheckLabels(job, set);
    CheckSurfaces(job, set);
    CheckBoxes(job, set);
  }
}

}  // namespace

LintPlace PictureSet::In(const FrameFolder& folder, const std::string& message) const {
  return {FrameFile(camera, folder, row.t_ns), 0, message};
}

PictureSet ReadPictures(LintJob* job, const std::string& camera, const FrameRow& row,
                        const std::vector<FrameFolder>& folders, PictureSize* size) {
  PictureSet set{camera, row, false, {}, {}, false};
  for (const FrameFolder& folder : folders) {
    if (folder.name == "rgb") {
      ReadOne(job, set, folder, size, &set.frame.rgb,
              [](const fs::path& file, auto* picture) { *picture = ReadRgbPng(file); });
    } else if (folder.name == "depth") {
      ReadOne(job, set, folder, size, &set.depth_mm,
              [](const fs::path& file, auto* picture) { *picture = ReadGrey16Png(file); });
    } else if (folder.name == kBoxes.name) {
      const fs::path file = job->Path(FrameFile(camera, folder, row.t_ns));
      std::error_code ignored;
      if (!fs::is_regular_file(file, ignored)) continue;
      set.has_boxes =
          Reads(job, "boxes.readable", set, folder, [&] { set.frame.boxes = ReadBoxes(file); });
    }
    ForEachLabel(set.frame, [&](const LabelChannel& channel, auto& picture) {
      if (channel.name != folder.name) return;
      ReadOne(job, set, folder, size, &picture,
              [&](const fs::path& file, auto* read) { ReadPng(file, channel.components, read); });
    });
  }
  return set;
}

void CheckCameras(LintJob* job) {
  const std::vector<std::string> cameras = job->recording().SensorsOf(ChannelForm::kPictures);
  for (const std::string& camera : cameras) {
    job->Try(camera, [&] { CheckPicturesOf(job, camera); });
  }
}

}  // namespace tera
