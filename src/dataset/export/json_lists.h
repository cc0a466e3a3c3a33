#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "dataset/files/checked_file.h"

namespace tera {

using OrderedJson = nlohmann::ordered_json;

/// Writes a JSON object whose lists may exceed the memory: one list after another, entry by entry.
class JsonLists {
 public:
  explicit JsonLists(const std::filesystem::path& path);

  /// Adds a member that fits into memory.
  void Put(const std::string& name, const OrderedJson& value);
  /// Starts a list. Ends the open list first, if there is one.
  void BeginList(const std::string& name);
  /// Appends an entry to the open list.
  void Add(const OrderedJson& entry);
  void Commit();

 private:
  void BeginMember(const std::string& name);

  CheckedFile file_;
  bool has_member_ = false, in_list_ = false, has_entry_ = false;
};

}  // namespace tera
