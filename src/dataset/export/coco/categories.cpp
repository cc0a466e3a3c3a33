#include "dataset/export/coco/categories.h"

#include <string>

namespace tera {
namespace {

OrderedJson CategoryJson(const SemanticClassInfo& info) {
  return {{"id", CategoryOf(info.label)},
          {"name", std::string(info.name)},
          {"supercategory", SupercategoryOf(info.label)},
          {"class_id", static_cast<int>(info.label)}};
}

}  // namespace

const char* SupercategoryOf(SemanticClass label) {
  switch (label) {
    case SemanticClass::kSky:
    case SemanticClass::kTerrain:
    case SemanticClass::kVegetation:
    case SemanticClass::kRock:
      return "nature";
    case SemanticClass::kUndercarriage:
    case SemanticClass::kUpperStructure:
    case SemanticClass::kBoom:
    case SemanticClass::kArm:
    case SemanticClass::kBucket:
    case SemanticClass::kBlade:
    case SemanticClass::kTrack:
      return "machine_part";
    case SemanticClass::kVehicle:
    case SemanticClass::kTruck:
      return "vehicle";
    case SemanticClass::kPerson:
      return "person";
    case SemanticClass::kBarrier:
    case SemanticClass::kCone:
    case SemanticClass::kStructure:
      return "site";
    case SemanticClass::kSoilInBucket:
      return "load";
    case SemanticClass::kDust:
    case SemanticClass::kRain:
      return "air";
  }
  return "";
}

int CategoryOf(SemanticClass label) { return static_cast<int>(label) + 1; }

bool IsThing(SemanticClass label) {
  return label != SemanticClass::kSky && label != SemanticClass::kTerrain &&
         label != SemanticClass::kDust && label != SemanticClass::kRain;
}

OrderedJson ThingCategories() {
  OrderedJson list = OrderedJson::array();
  for (const SemanticClassInfo& info : kSemanticClasses) {
    if (IsThing(info.label)) list.push_back(CategoryJson(info));
  }
  return list;
}

OrderedJson PanopticCategories() {
  OrderedJson list = OrderedJson::array();
  for (const SemanticClassInfo& info : kSemanticClasses) {
    OrderedJson category = CategoryJson(info);
    category["isthing"] = IsThing(info.label) ? 1 : 0;
    category["color"] = info.rgb;
    list.push_back(category);
  }
  return list;
}

}  // namespace tera
