#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/export/json_lists.h"

namespace tera {

/// The kinds of key points that objects have, each a category of COCO's.
///
/// Model   persons with COCO's 17 points are of the category `person` of the other files, their
///         points in COCO's order. Objects of one class whose points bear other names, in other
///         order, are a category of their own, "vehicle_1" and on, numbered from 1001.
/// Source  COCO, "Keypoint detection" of its data format.
class KeypointCategories {
 public:
  /// The members `category_id`, `keypoints` and `num_keypoints` of an object's annotation: x, y and
  /// v of each point, v 2 seen, 1 hidden, 0 (and x, y 0) beyond the picture.
  void Annotate(const ObjectBox& box, OrderedJson* annotation);
  /// The list `categories` of all that were used.
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
