#include "core/config/merge_keys.h"

#include <vector>

namespace tera::internal {
namespace {

constexpr char kMergeKey[] = "<<";

void Merge(const YAML::Node& from, YAML::Node* into) {
  if (from.IsSequence()) {
    for (const YAML::Node& one : from) Merge(one, into);
    return;
  }
  if (!from.IsMap()) {
    throw YAML::Exception(from.Mark(), "the merge key '<<' needs a mapping or a list of mappings");
  }
  for (const auto& entry : from) {
    if (!(*into)[entry.first.Scalar()]) (*into)[entry.first.Scalar()] = entry.second;
  }
}

}  // namespace

namespace {

void Apply(YAML::Node node, int depth) {
  constexpr int kDeepest = 100;
  if (depth > kDeepest) {
    throw YAML::Exception(node.Mark(), "nested too deeply, or an anchor within what it names");
  }
  if (node.IsSequence()) {
    for (YAML::Node child : node) Apply(child, depth + 1);
    return;
  }
  if (!node.IsMap()) return;
  for (auto entry : node) Apply(entry.second, depth + 1);
  const YAML::Node merged = node[kMergeKey];
  if (!merged) return;
  node.remove(kMergeKey);
  Merge(merged, &node);
}

}  // namespace

void ApplyMergeKeys(const YAML::Node& node) { Apply(node, 0); }

}  // namespace tera::internal
