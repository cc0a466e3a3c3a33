#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/export/json_lists.h"

namespace tera {

/// Kinds of key points, each a COCO category.
///
/// Model   persons with COCO's 17 points have the category `person` of the other files, with their
///         points in COCO's order. Objects of a class with other point names or another order get
///         their own category, "vehicle_1" and on, numbered from 1001.
/// Source  COCO, "Keypoint detection" of its data format.
class KeypointCategories {
 public:
  /// Adds `category_id`, `keypoints` and `num_keypoints` to an object's annotation: x, y and v of
  /// each point. v is 2 for visible, 1 for hidden, 0 (with x, y 0) for points outside the picture.
  void Annotate(const ObjectBox& box, OrderedJson* annotation);
  /// The list `categories` of all used categories.
  OrderedJson Json() const;
  bool empty() const { return categories_.empty(); }

 private:
  struct Category {
    int id = 0;
    SemanticClass label = SemanticClass::kSky;
    std::string name;
    std::vector<std::string> points;
  };
  const Category& CategoryOf(const ObjectBox& box);

  std::vector<Category> categories_;
};

}  // namespace tera
