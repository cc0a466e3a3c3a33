#include "core/config/config.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/config_layers.h"
#include "core/config/merge_keys.h"
#include "core/error.h"

namespace tera {
namespace fs = std::filesystem;

using internal::Layer;

namespace {

void NeedFile(const fs::path& file, const std::string& shown) {
  if (internal::IsFile(file)) return;
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    const fs::path scenario = file / "scenario.yaml";
    const std::string example = internal::IsFile(scenario) ? ", such as " + scenario.string() : "";
    throw InputError(file.string(),
                     {FaultKind::kUnreadable, "is a folder; need a YAML file" + example});
  }
  throw InputError(shown, {FaultKind::kUnreadable, "no such file; need a YAML file"});
}

Layer OverlayLayer(const Config::Overlay& overlay) {
  const std::string shown = internal::ShownName(overlay.file);
  NeedFile(overlay.file, shown);
  const Layer layer{internal::LoadYaml(overlay.file, shown), shown, overlay.file.parent_path(), ""};
  if (!internal::ValueIn(layer.node, overlay.key) || layer.node.size() != 1) {
    throw InputError(shown + ":1:1",
                     {FaultKind::kMalformed,
                      fmt::format("need one mapping, '{}:', and nothing else", overlay.key)});
  }
  return layer;
}

/// Adds a fault unless it is already in the list. Faults repeat if a key is read twice or a file
/// occurs in two layers.
void AddOnce(InputFault fault, std::vector<InputFault>* faults) {
  if (std::find(faults->begin(), faults->end(), fault) == faults->end()) {
    faults->push_back(std::move(fault));
  }
}

}  // namespace

Config Config::FromFile(const fs::path& file, const std::vector<std::string>& overrides,
                        const std::vector<Overlay>& overlays) {
  const std::string shown = internal::ShownName(file);
  NeedFile(file, shown);
  auto document = std::make_shared<internal::ConfigDocument>();
  const Layer layer{internal::LoadYaml(file, shown), shown, file.parent_path(), ""};
  const std::vector<Layer> with_overrides = internal::LayersAbove(layer, overrides);
  // Layers are built from top to bottom, because assigning or inserting a yaml-cpp node changes the
  // node behind all of its handles.
  std::vector<Layer> layers(with_overrides.begin(), with_overrides.end() - 1);
  for (auto overlay = overlays.rbegin(); overlay != overlays.rend(); ++overlay) {
    layers.push_back(OverlayLayer(*overlay));
  }
  layers.push_back(with_overrides.back());
  document->root = document->AddNode(std::move(layers));
  return Config(document);
}

Config Config::FromText(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides) {
  YAML::Node node;
  try {
    node = YAML::Load(text);
    internal::ApplyMergeKeys(node);
  } catch (const YAML::Exception& e) {
    throw InputError(fmt::format("{}:{}:{}", name, e.mark.line + 1, e.mark.column + 1),
                     fault::NotValidYaml(e.msg));
  }
  if (!node.IsMap()) throw InputError(name + ":1:1", fault::NotAMapping());
  auto document = std::make_shared<internal::ConfigDocument>();
  document->root = document->AddNode(
      internal::LayersAbove(Layer{node, name, fs::current_path(), ""}, overrides));
  return Config(document);
}

void Config::LayOver(const std::vector<GivenValue>& values) {
  // Rebuilds the root's layers from top to bottom, as in FromFile.
  std::vector<Layer> above, file;
  for (const Layer& layer : document_->root->layers) {
    (layer.is_patch ? above : file).push_back(layer);
  }
  for (auto value = values.rbegin(); value != values.rend(); ++value) {
    auto layer =
        internal::PatchLayer(value->path, value->yaml, value->place, file.back().directory);
    if (layer) {
      above.push_back(*layer);
    } else {
      document_->faults.emplace_back(
          FaultKind::kMalformed,
          fmt::format("'{}' is no key path, need key.path, items of lists as key[0]", value->path),
          value->place);
    }
  }
  above.insert(above.end(), file.begin(), file.end());
  document_->root->layers.swap(above);
}

void Config::LeaveOut(const std::string& key) { document_->root->resolved.remove(key); }

void Config::Move(std::vector<MovedFiles> moved) { document_->moved = std::move(moved); }

ConfigMap Config::root() const { return ConfigMap(document_->root); }

void Config::Finish() const {
  // Mistyped keys come first, because other faults often follow from them.
  std::vector<InputFault> faults;
  for (const auto& node : document_->nodes) {
    if (node->unread) continue;
    for (const Layer& layer : node->layers) {
      std::set<std::string> seen;
      for (const auto& entry : layer.node) {
        const std::string key = entry.first.Scalar();
        const bool repeated = !seen.insert(key).second;
        if (!repeated && node->asked.contains(key)) continue;
        InputFault fault = repeated
                               ? fault::RepeatedKey()
                               : fault::UnknownKey(key, {node->asked.begin(), node->asked.end()});
        fault.place = fmt::format("{}: {}", internal::PlaceOf(entry.first, layer),
                                  internal::Join(layer.path, key));
        AddOnce(std::move(fault), &faults);
      }
    }
  }
  for (const InputFault& fault : document_->faults) AddOnce(fault, &faults);
  if (!faults.empty()) throw InputError(std::move(faults));
}

std::string Config::ResolvedYaml() const {
  YAML::Emitter emitter;
  emitter << document_->root->resolved;
  return std::string(emitter.c_str()) + "\n";
}
}  // namespace tera
