#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/lint/checks/frames.h"
#include "dataset/lint/lint_job.h"

namespace tera {

/// The pictures of one frame of one camera that can be read and have the right size; others are
/// empty.
struct PictureSet {
  std::string camera;
  FrameRow row;
  bool is_first = false;  ///< of its camera
  CameraFrame frame;      ///< without depth_m
  Image<std::uint16_t> depth_mm;
  bool has_boxes = false;  ///< frame.boxes is what the file holds

  /// A place in one of the frame's files.
  LintPlace In(const FrameFolder& folder, const std::string& message) const;
  LintPlace In(std::string_view folder, const std::string& message) const {
    return In(FrameFolder{folder, "png"}, message);
  }
};

/// Reads the frame's files in `folders`, and tells those that are damaged or of another size than
/// `size`, which the first picture sets where it is not known.
PictureSet ReadPictures(LintJob* job, const std::string& camera, const FrameRow& row,
                        const std::vector<FrameFolder>& folders,
                        std::optional<std::pair<int, int>>* size);

// What one frame's pictures say, each a topic.
void CheckLabels(LintJob* job, const PictureSet& set);    ///< classes and instances
void CheckSurfaces(LintJob* job, const PictureSet& set);  ///< depth, normals, flow
void CheckBoxes(LintJob* job, const PictureSet& set);

}  // namespace tera
