#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tera {

/// A mask as run lengths, column by column from the left, each from the top.
///
/// Model   run 0 is outside, run 1 inside, and so on; run 0 may be empty.
/// Source  COCO API, `maskApi.h`.
class RunLengths {
 public:
  /// Adds `count` inside pixels from `first` on. `first` must be at or after the end of the runs so
  /// far.
  void Add(std::int64_t first, std::int64_t count);
  /// Number of inside pixels.
  std::int64_t area_px() const { return area_px_; }
  /// COCO's compressed text of the runs of a picture of `pixels`. Each run from the fourth on is
  /// stored minus the run two before it. It is split into groups of five bits, lowest first, with
  /// the sixth bit as continuation, plus 48.
  std::string Compressed(std::int64_t pixels) const;

 private:
  std::vector<std::int64_t> runs_;
  std::int64_t end_ = 0, area_px_ = 0;
};

}  // namespace tera
