#include "dataset/export/json_lists.h"

#include "core/check.h"

namespace tera {

JsonLists::JsonLists(const std::filesystem::path& path) : file_(path) { file_.Append("{"); }

void JsonLists::BeginMember(const std::string& name) {
  if (in_list_) file_.Append("\n]");
  in_list_ = false;
  file_.Append((has_member_ ? ",\n" : "\n") + OrderedJson(name).dump() + ": ");
  has_member_ = true;
}

void JsonLists::Put(const std::string& name, const OrderedJson& value) {
  BeginMember(name);
  file_.Append(value.dump());
}

void JsonLists::BeginList(const std::string& name) {
  BeginMember(name);
  file_.Append("[");
  in_list_ = true;
  has_entry_ = false;
}

void JsonLists::Add(const OrderedJson& entry) {
  TERA_CHECK(in_list_);
  file_.Append((has_entry_ ? ",\n" : "\n") + entry.dump());
  has_entry_ = true;
}

void JsonLists::Commit() {
  file_.Append(in_list_ ? "\n]\n}\n" : "\n}\n");
  file_.Commit();
}

}  // namespace tera
