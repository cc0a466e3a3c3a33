#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tera {

/// A mask as lengths of runs, column after column from the left, each from the top.
///
/// Model   run 0 is of pixels outside, run 1 of pixels inside, and so on; run 0 may be empty.
/// Source  COCO API, `maskApi.h`.
class RunLengths {
 public:
  /// `count` pixels inside from pixel `first` on, which is not before the end of the last run.
  void Add(std::int64_t first, std::int64_t count);
  /// Pixels inside.
  std::int64_t area_px() const { return area_px_; }
  /// COCO's compressed text of the runs of a picture of `pixels`: each run from the fourth on less
  /// the one two before it, in groups of five bits, lowest first, the sixth bit set where more
  /// follow, plus 48.
  std::string Compressed(std::int64_t pixels) const;

 private:
  std::vector<std::int64_t> runs_;
  std::int64_t end_ = 0, area_px_ = 0;
};

}  // namespace tera
