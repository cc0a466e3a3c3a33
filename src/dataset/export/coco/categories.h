#pragma once

#include "core/types/labels.h"
#include "dataset/export/json_lists.h"

namespace tera {

/// COCO category of a class: the dataset's class number plus one, because readers treat 0 as none.
int CategoryOf(SemanticClass label);

/// Supercategory, such as "vehicle" or "machine_part".
const char* SupercategoryOf(SemanticClass label);

/// True if the class is a thing in COCO's terms. Sky, terrain, dust and rain are stuff.
bool IsThing(SemanticClass label);

/// Values of the key `categories`: things only, or all classes for panoptic labels.
OrderedJson ThingCategories();
OrderedJson PanopticCategories();

}  // namespace tera
