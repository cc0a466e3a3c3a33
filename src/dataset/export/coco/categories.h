#pragma once

#include "core/types/labels.h"
#include "dataset/export/json_lists.h"

namespace tera {

/// COCO's number of a class: the dataset's and one, as programs take 0 for none.
int CategoryOf(SemanticClass label);

/// "vehicle", "machine_part", ...
const char* SupercategoryOf(SemanticClass label);

/// Whether a class is of things, which can be counted; else of stuff.
bool IsThing(SemanticClass label);

/// The list `categories` of things alone, or of all classes as panoptic labels have them.
OrderedJson ThingCategories();
OrderedJson PanopticCategories();

}  // namespace tera
