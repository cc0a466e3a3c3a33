#include "dataset/export/coco/keypoint_categories.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/types/labels.h"
#include "dataset/export/coco/categories.h"

namespace tera {
namespace {

constexpr std::array<std::string_view, 17> kPersonPoints = {
    "nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
    "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
    "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle"};

/// Skeleton of COCO: pairs of points joined by lines, counted from 1.
constexpr std::array<std::pair<int, int>, 19> kPersonSkeleton = {{{16, 14},
                                                                  {14, 12},
                                                                  {17, 15},
                                                                  {15, 13},
                                                                  {12, 13},
                                                                  {6, 12},
                                                                  {7, 13},
                                                                  {6, 7},
                                                                  {6, 8},
                                                                  {7, 9},
                                                                  {8, 10},
                                                                  {9, 11},
                                                                  {2, 3},
                                                                  {1, 2},
                                                                  {1, 3},
                                                                  {2, 4},
                                                                  {3, 5},
                                                                  {4, 6},
                                                                  {5, 7}}};

constexpr int kFirstOwnCategory = 1001;

const Keypoint* PointOf(const ObjectBox& box, std::string_view name) {
  const auto found = std::find_if(box.keypoints.begin(), box.keypoints.end(),
                                  [&](const Keypoint& p) { return p.name == name; });
  return found != box.keypoints.end() ? &*found : nullptr;
}

bool IsPerson(const ObjectBox& box) {
  return box.label == SemanticClass::kPerson && box.keypoints.size() == kPersonPoints.size() &&
         std::all_of(kPersonPoints.begin(), kPersonPoints.end(),
                     [&](std::string_view name) { return PointOf(box, name) != nullptr; });
}

std::vector<std::string> NamesOf(const ObjectBox& box) {
  if (IsPerson(box)) return {kPersonPoints.begin(), kPersonPoints.end()};
  std::vector<std::string> names;
  for (const Keypoint& point : box.keypoints) names.push_back(point.name);
  return names;
}

}  // namespace

const KeypointCategories::Category& KeypointCategories::CategoryOf(const ObjectBox& box) {
  const std::vector<std::string> names = NamesOf(box);
  const auto known = std::find_if(categories_.begin(), categories_.end(), [&](const Category& c) {
    return c.label == box.label && c.points == names;
  });
  if (known != categories_.end()) return *known;
  const bool is_person = IsPerson(box);
  const auto count_own = [&](bool of_class) {
    return static_cast<int>(
        std::count_if(categories_.begin(), categories_.end(), [&](const Category& c) {
          return c.id >= kFirstOwnCategory && (!of_class || c.label == box.label);
        }));
  };
  const std::string name(NameOf(box.label));
  categories_.push_back(
      {is_person ? tera::CategoryOf(box.label) : kFirstOwnCategory + count_own(false), box.label,
       is_person ? name : fmt::format("{}_{}", name, 1 + count_own(true)), names});
  return categories_.back();
}

void KeypointCategories::Annotate(const ObjectBox& box, OrderedJson* annotation) {
  const Category& category = CategoryOf(box);
  OrderedJson numbers = OrderedJson::array();
  int labelled = 0;
  for (const std::string& name : category.points) {
    const Keypoint& point = *PointOf(box, name);
    const bool is_inside = point.sight != KeypointSight::kOutside && point.pixel_px.has_value();
    numbers.push_back(is_inside ? point.pixel_px->x() : 0.0);
    numbers.push_back(is_inside ? point.pixel_px->y() : 0.0);
    numbers.push_back(is_inside ? static_cast<int>(point.sight) : 0);
    labelled += is_inside ? 1 : 0;
  }
  (*annotation)["category_id"] = category.id;
  (*annotation)["keypoints"] = numbers;
  (*annotation)["num_keypoints"] = labelled;
}

OrderedJson KeypointCategories::Json() const {
  OrderedJson list = OrderedJson::array();
  for (const Category& category : categories_) {
    OrderedJson skeleton = OrderedJson::array();
    if (category.id < kFirstOwnCategory) {
      for (const auto& [from, to] : kPersonSkeleton) skeleton.push_back({from, to});
    }
    list.push_back({{"id", category.id},
                    {"name", category.name},
                    {"supercategory", SupercategoryOf(category.label)},
                    {"class_id", static_cast<int>(category.label)},
                    {"keypoints", category.points},
                    {"skeleton", skeleton}});
  }
  return list;
}

}  // namespace tera
