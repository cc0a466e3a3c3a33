#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "dataset/files/checked_file.h"

namespace tera {

using OrderedJson = nlohmann::ordered_json;

/// A JSON file of one object with lists that are larger than memory: they are written one after the
/// other, entry by entry.
class JsonLists {
 public:
  explicit JsonLists(const std::filesystem::path& path);

  /// A member that is no long list.
  void Put(const std::string& name, const OrderedJson& value);
  /// Ends the list before it, if there is one.
  void BeginList(const std::string& name);
  /// To the list that was begun last.
  void Add(const OrderedJson& entry);
  void Commit();

 private:
  void BeginMember(const std::string& name);

  CheckedFile file_;
  bool has_member_ = false, in_list_ = false, has_entry_ = false;
};

}  // namespace tera
