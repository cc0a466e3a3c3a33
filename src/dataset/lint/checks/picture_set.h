#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/lint/checks/frames.h"
#include "dataset/lint/lint_job.h"

namespace tera {

/// The pictures of one frame of one camera. Unreadable pictures and those of the wrong size are
/// empty.
struct PictureSet {
  std::string camera;
  FrameRow row;
  bool is_first = false;  ///< first frame of its camera
  CameraFrame frame;      ///< without depth_m
  Image<std::uint16_t> depth_mm;
  bool has_boxes = false;  ///< frame.boxes has the file's boxes

  /// A place in one of the frame's files.
  LintPlace In(const FrameFolder& folder, const std::string& message) const;
  LintPlace In(std::string_view folder, const std::string& message) const {
    return In(FrameFolder{folder, "png"}, message);
  }
};

/// Reads the frame's files in `folders`. Reports damaged pictures and those of another size than
/// `size`; the first picture sets an unknown size.
PictureSet ReadPictures(LintJob* job, const std::string& camera, const FrameRow& row,
                        const std::vector<FrameFolder>& folders,
                        std::optional<std::pair<int, int>>* size);

// Checks of one frame's pictures, each on one topic.
void CheckLabels(LintJob* job, const PictureSet& set);    ///< classes and instances
void CheckSurfaces(LintJob* job, const PictureSet& set);  ///< depth, normals, flow
void CheckBoxes(LintJob* job, const PictureSet& set);

}  // namespace tera
