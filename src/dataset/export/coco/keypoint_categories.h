#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/export/json_lists.h"

namespace tera {

/// Categories of objects with key points.
///
/// Model   A person with the 17 COCO points gets the category `person` of the other files; its
///         points are sorted as COCO sorts them. Any other combination of class, point names and
///         their order is a category of its own, such as "vehicle_1". These are numbered from 1001.
/// Source  COCO, "Keypoint detection" of its data format.
class KeypointCategories {
 public:
  /// Adds `category_id`, `keypoints` and `num_keypoints` to the annotation of an object. A key
  /// point has x, y and v: v = 2 if visible, 1 if hidden, 0 (with x = y = 0) outside the image.
  void Annotate(const ObjectBox& box, OrderedJson* annotation);
  /// Value of the key `categories`, with all categories used so far.
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
