#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tera {

/// A mask as run lengths in column-major order: columns from left to right, pixels from top to
/// bottom.
///
/// Model   Runs alternate between outside and inside, beginning with outside. The first run may be
///         empty.
/// Source  COCO API, `maskApi.h`.
class RunLengths {
 public:
  /// Adds `count` inside pixels from index `first` on. `first` must not lie before the end of the
  /// last run.
  void Add(std::int64_t first, std::int64_t count);
  std::int64_t area_px() const { return area_px_; }
  /// Text of COCO's compressed run lengths for an image of `pixels` pixels. From the fourth run on,
  /// a run is stored as its difference from the run two before it. A number is split into groups of
  /// five bits, lowest first. A sixth bit marks continuation; 48 is added to make a character.
  std::string Compressed(std::int64_t pixels) const;

 private:
  std::vector<std::int64_t> runs_;
  std::int64_t end_ = 0, area_px_ = 0;
};

}  // namespace tera
