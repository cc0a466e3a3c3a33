#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/lint/checks/frames.h"
#include "dataset/lint/lint_job.h"

namespace tera {

/// Images of one frame of a camera. An image that is unreadable or has a wrong size is empty.
struct PictureSet {
  std::string camera;
  FrameRow row;
  bool is_first = false;
  CameraFrame frame;  ///< without depth_m
  Image<std::uint16_t> depth_mm;
  bool has_boxes = false;  ///< frame.boxes holds the content of the boxes file

  /// Place of a finding in one of the frame's files.
  LintPlace In(const FrameFolder& folder, const std::string& message) const;
  LintPlace In(std::string_view folder, const std::string& message) const {
    return In(FrameFolder{folder, "png"}, message);
  }
};

/// Reads the frame's files in `folders`. Reports damaged images, and images of another size than
/// `size`. If `size` is unknown, the first image defines it.
PictureSet ReadPictures(LintJob* job, const std::string& camera, const FrameRow& row,
                        const std::vector<FrameFolder>& folders,
                        std::optional<std::pair<int, int>>* size);

// Checks of the images of one frame.
void CheckLabels(LintJob* job, const PictureSet& set);    ///< classes and instances
void CheckSurfaces(LintJob* job, const PictureSet& set);  ///< depth, normals, flow
void CheckBoxes(LintJob* job, const PictureSet& set);

}  // namespace tera
