#pragma once

#include "core/types/labels.h"
#include "dataset/export/json_lists.h"

namespace tera {

/// COCO's number of a class: the dataset's number plus one, since readers take 0 for none.
int CategoryOf(SemanticClass label);

/// "vehicle", "machine_part", ...
const char* SupercategoryOf(SemanticClass label);

/// Whether the class is a thing in COCO's sense. Sky, terrain, dust and rain are stuff.
bool IsThing(SemanticClass label);

/// The list `categories`: things only, or all classes for panoptic labels.
OrderedJson ThingCategories();
OrderedJson PanopticCategories();

}  // namespace tera
