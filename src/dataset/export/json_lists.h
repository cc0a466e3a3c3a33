#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "dataset/files/checked_file.h"

namespace tera {

using OrderedJson = nlohmann::ordered_json;

/// Streams a JSON object with lists that are larger than memory, one list after another, entry by
/// entry.
class JsonLists {
 public:
  explicit JsonLists(const std::filesystem::path& path);

  /// Adds a member other than a long list.
  void Put(const std::string& name, const OrderedJson& value);
  /// Ends the current list, if any.
  void BeginList(const std::string& name);
  /// Adds to the current list.
  void Add(const OrderedJson& entry);
  void Commit();

 private:
  void BeginMember(const std::string& name);

  CheckedFile file_;
  bool has_member_ = false, in_list_ = false, has_entry_ = false;
};

}  // namespace tera
