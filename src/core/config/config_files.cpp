#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include "core/config/config.h"
#include "core/config/config_layers.h"
#include "core/config/kept_texts.h"
#include "core/config/listed_folder.h"
#include "core/config/merge_keys.h"
#include "core/config/portable_name.h"
#include "core/error.h"

/// Files that a configuration names: their locations, presets, and the data shipped with TERA.

namespace tera {
namespace fs = std::filesystem;

namespace {
thread_local KeptTexts* kept_texts = nullptr;
}  // namespace

KeptTexts::Reading::Reading(KeptTexts* texts) : outer_(std::exchange(kept_texts, texts)) {}

KeptTexts::Reading::~Reading() { kept_texts = outer_; }

std::optional<std::string> KeptTexts::TextOf(const fs::path& file) {
  const std::string place = internal::Canonical(file).string();
  if (kept_texts != nullptr) {
    const std::lock_guard lock(kept_texts->mutex_);
    const auto kept = kept_texts->texts_.find(place);
    if (kept != kept_texts->texts_.end()) return kept->second;
  }
  std::ifstream stream(file);
  if (!stream) return std::nullopt;
  std::stringstream text;
  text << stream.rdbuf();
  if (kept_texts == nullptr) return text.str();
  const std::lock_guard lock(kept_texts->mutex_);
  return kept_texts->texts_.emplace(place, text.str()).first->second;
}

namespace internal {
namespace {

/// The base of a layer's relative paths, as messages name it.
std::string BaseOf(const Layer& layer) {
  return layer.file == kOverlayName ? "the working directory" : layer.file;
}

}  // namespace

bool IsFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

fs::path ConfigDocument::PlaceOf(const std::string& name, const fs::path& named) const {
  const bool is_moved = std::any_of(moved.begin(), moved.end(),
                                    [&](const MovedFiles& files) { return Concerns(files, name); });
  return is_moved ? PlaceOfInput(name, moved) : named;
}

fs::path Canonical(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path.lexically_normal() : canonical;
}

fs::path Resolve(const std::string& text, const fs::path& directory) {
  if (text.starts_with("tera:")) return DataRoot() / text.substr(5);
  const fs::path path(text);
  return path.is_absolute() ? path : directory / path;
}

std::string ShownName(const fs::path& path) {
  const fs::path relative = Canonical(path).lexically_relative(fs::current_path());
  return !relative.empty() && *relative.begin() != ".." ? relative.generic_string()
                                                        : path.lexically_normal().generic_string();
}

YAML::Node LoadYaml(const fs::path& file, const std::string& shown) {
  const std::optional<std::string> text = KeptTexts::TextOf(file);
  if (!text) throw InputError(shown, fault::CannotBeRead("a readable YAML file"));
  const std::size_t start = text->find_first_not_of(" \t\r\n");
  if (start != std::string::npos && (*text)[start] == '<') {
    throw InputError(shown + ":1:1",
                     {FaultKind::kMalformed,
                      "is XML; need YAML (a URDF is named by the key `urdf` of a machine "
                      "file, docs/guide/my-machine.md)"});
  }
  try {
    YAML::Node node = YAML::Load(*text);
    ApplyMergeKeys(node);
    if (!node.IsMap()) throw InputError(shown + ":1:1", fault::NotAMapping("at the top"));
    return node;
  } catch (const YAML::Exception& e) {
    throw InputError(fmt::format("{}:{}:{}", shown, e.mark.line + 1, e.mark.column + 1),
                     fault::NotValidYaml(e.msg));
  }
}

std::optional<Layer> LoadLayer(ConfigNode& node, std::string_view key, const Found& found,
                               const std::string& mapping_path) {
  const fs::path path = Resolve(found.node.Scalar(), found.layer->directory);
  if (!IsFile(path)) {
    AddFault(node, key, found, fault::NoSuchFile(found.node.Scalar(), BaseOf(*found.layer)));
    return std::nullopt;
  }
  const std::string shown = ShownName(path);
  try {
    return Layer{LoadYaml(path, shown), shown, path.parent_path(), mapping_path};
  } catch (const InputError& e) {
    const auto& faults = e.faults();
    node.document->faults.insert(node.document->faults.end(), faults.begin(), faults.end());
    return std::nullopt;
  }
}

}  // namespace internal

using internal::AddFault;
using internal::AddMissing;
using internal::Find;
using internal::Found;
using internal::Record;
using internal::Shown;

void ConfigMap::ApplyPreset(std::string_view key) const {
  std::set<fs::path> applied;
  for (auto found = Find(*node_, key); found;) {
    if (!found->node.IsScalar()) {
      AddFault(*node_, key, *found, fault::Mistyped(Shown(found->node), "a file's path"));
      return;
    }
    const fs::path file = internal::Resolve(found->node.Scalar(), found->layer->directory);
    if (!applied.insert(internal::Canonical(file)).second) {
      AddFault(*node_, key, *found,
               fmt::format("'{}' is a preset of itself; leave the key out of one of the files",
                           found->node.Scalar()));
      return;
    }
    const auto layer = internal::LoadLayer(*node_, key, *found, found->layer->path);
    if (!layer) {
      node_->unread = true;
      return;
    }
    node_->layers.push_back(*layer);
    const auto next = internal::ValueIn(layer->node, key);
    found = next ? std::optional(Found{*next, &node_->layers.back()}) : std::nullopt;
  }
}

namespace {

/// The file that `found` names, with its name for the resolved document. If `found` names a folder,
/// the result is the file `list` in it.
std::optional<InputFile> FileAt(internal::ConfigNode& node, std::string_view key,
                                const Found& found, const std::string& list) {
  if (!found.node.IsScalar()) {
    AddFault(node, key, found, fault::Mistyped(Shown(found.node), "a file's path"));
    return std::nullopt;
  }
  fs::path named = internal::Resolve(found.node.Scalar(), found.layer->directory);
  if (!list.empty() && internal::IsFile(named / list)) named /= list;
  const std::string name = PortableName(named);
  const fs::path path = node.document->PlaceOf(name, named).lexically_normal();
  if (!internal::IsFile(path)) {
    AddFault(node, key, found,
             fault::NoSuchFile(found.node.Scalar(), internal::BaseOf(*found.layer)));
    return std::nullopt;
  }
  node.document->inputs.emplace(name, path);
  return InputFile{name, path};
}

std::optional<Found> FoundFile(internal::ConfigNode& node, std::string_view key) {
  const auto found = Find(node, key);
  if (!found) AddMissing(node, key, "a file's path");
  return found;
}

}  // namespace

fs::path ConfigMap::File(std::string_view key) const {
  const auto found = FoundFile(*node_, key);
  const auto file = found ? FileAt(*node_, key, *found, "") : std::nullopt;
  if (!file) return {};
  Record(*node_, key, file->name);
  return file->path;
}

std::vector<fs::path> FilesOrList(const ConfigMap& config, std::string_view key,
                                  const std::string& list) {
  internal::ConfigNode& node = internal::ConfigDocument::NodeOf(config);
  const auto found = FoundFile(node, key);
  if (!found) return {};
  if (!found->node.IsSequence()) {
    const auto file = FileAt(node, key, *found, list);
    if (!file) return {};
    Record(node, key, file->name);
    return {file->path};
  }
  std::vector<fs::path> paths;
  YAML::Node names(YAML::NodeType::Sequence);
  for (std::size_t k = 0; k < found->node.size(); ++k) {
    const auto file =
        FileAt(node, fmt::format("{}[{}]", key, k), {found->node[k], found->layer}, "");
    if (!file) return {};
    paths.push_back(file->path);
    names.push_back(file->name);
  }
  if (paths.empty()) AddFault(node, key, *found, fault::Missing("files' paths"));
  node.resolved[std::string(key)] = names;
  return paths;
}

fs::path Folder(const ConfigMap& config, std::string_view key) {
  internal::ConfigNode& node = internal::ConfigDocument::NodeOf(config);
  const auto found = Find(node, key);
  if (!found || !found->node.IsScalar()) {
    config.Fault(key, "need a folder's path");
    return {};
  }
  const fs::path named = internal::Resolve(found->node.Scalar(), found->layer->directory);
  const std::string name = PortableName(named);
  const fs::path path = node.document->PlaceOf(name, named).lexically_normal();
  std::error_code unreadable;
  if (!fs::is_directory(path, unreadable)) {
    AddFault(node, key, *found,
             fmt::format("folder '{}' does not exist; correct the path (relative to {})",
                         found->node.Scalar(), internal::BaseOf(*found->layer)));
    return {};
  }
  Record(node, key, name);
  return path;
}

std::optional<fs::path> ConfigMap::OptionalFile(std::string_view key) const {
  if (!Has(key)) return std::nullopt;
  return File(key);
}

void ConfigMap::AlsoReads(const fs::path& file) const {
  node_->document->inputs.emplace(PortableName(file), file);
}

std::vector<InputFile> ConfigMap::Inputs() const {
  std::vector<InputFile> inputs;
  for (const auto& [name, path] : node_->document->inputs) inputs.push_back({name, path});
  return inputs;
}

fs::path DataRoot() {
  if (const char* directory = std::getenv("TERA_DATA_DIR")) return directory;
  // The data is found next to the program, because an installation may be moved away from its build
  // prefix.
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path beside = (program.parent_path() / TERA_DATA_FROM_BIN_DIR).lexically_normal();
  if (!program.empty() && fs::is_directory(beside / "shaders")) return beside;
  if (fs::is_directory(TERA_SOURCE_DATA_DIR)) return TERA_SOURCE_DATA_DIR;
  return TERA_INSTALL_DATA_DIR;
}

}  // namespace tera
