#include "render/meshes/gltf_textures.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"

namespace tera {
namespace {

constexpr int kChannels = 4;
constexpr const char* kRemedy = "export the file again with PNG or JPEG pictures embedded";

/// A texture slot of a material.
struct Use {
  int texture, uv_set;
  const tinygltf::ExtensionMap* extensions;
};

template <typename Info>
Use UseOf(const Info& info) {
  return {info.index, info.texCoord, &info.extensions};
}

std::array<Use, 5> UsesOf(const tinygltf::Material& material) {
  const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
  return {UseOf(pbr.baseColorTexture), UseOf(pbr.metallicRoughnessTexture),
          UseOf(material.normalTexture), UseOf(material.occlusionTexture),
          UseOf(material.emissiveTexture)};
}

[[noreturn]] void Refuse(const std::filesystem::path& file, const tinygltf::Material& material,
                         const InputFault& fault) {
  throw InputError(file.string(),
                   {fault.kind, fmt::format("material '{}' {}", material.name, fault.finding)});
}

std::string NameOf(const tinygltf::Image& image, int index) {
  if (!image.uri.empty() && !image.uri.starts_with("data:")) return image.uri;
  return image.name.empty() ? fmt::format("image {}", index) : image.name;
}

Texture::Wrap WrapOf(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Wrap::kClamp;
  if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Texture::Wrap::kMirror;
  return Texture::Wrap::kRepeat;
}

/// Decodes the bytes that KeepImageBytes kept.
Texture Decode(const std::filesystem::path& file, const tinygltf::Material& material,
               const tinygltf::Image& kept, int index) {
  const std::string name = NameOf(kept, index);
  if (kept.image.empty()) {
    Refuse(file, material,
           {FaultKind::kMalformed,
            fmt::format("needs the picture '{}', which is missing; put it beside the file, or {}",
                        name, kRemedy)});
  }
  tinygltf::Image image;
  std::string error, warning;
  const bool ok = tinygltf::LoadImageData(&image, index, &error, &warning, 0, 0, kept.image.data(),
                                          static_cast<int>(kept.image.size()), nullptr);
  if (!ok || image.image.empty() || image.bits != 8 || image.component != kChannels) {
    Refuse(file, material,
           {FaultKind::kMalformed,
            fmt::format("has '{}', {} bytes that are no picture of 8 bits a channel; need PNG or "
                        "JPEG: {}",
                        name, kept.image.size(), kRemedy)});
  }
  Texture texture;
  texture.width_px = image.width;
  texture.height_px = image.height;
  texture.rgba = std::move(image.image);
  return texture;
}

std::shared_ptr<const Texture> Read(const std::filesystem::path& file, const tinygltf::Model& model,
                                    const tinygltf::Material& material, int index,
                                    Textures* known) {
  if (index < 0) return nullptr;
  if (index >= static_cast<int>(model.textures.size())) {
    Refuse(file, material,
           {FaultKind::kNoSuchName, fmt::format("names texture {}, which does not exist", index)});
  }
  const int source = model.textures[index].source;
  if (source < 0 || source >= static_cast<int>(model.images.size())) {
    Refuse(file, material,
           {FaultKind::kMalformed,
            fmt::format("has texture {} without a PNG or JPEG picture; {}", index, kRemedy)});
  }
  const std::string name = fmt::format("{}#texture{}", file.string(), index);
  std::shared_ptr<const Texture>& entry = (*known)[name];
  if (entry) return entry;
  Texture texture = Decode(file, material, model.images[source], source);
  texture.name = name;
  const int sampler = model.textures[index].sampler;
  if (sampler >= 0 && sampler < static_cast<int>(model.samplers.size())) {
    texture.wrap_x = WrapOf(model.samplers[sampler].wrapS);
    texture.wrap_y = WrapOf(model.samplers[sampler].wrapT);
  }
  return entry = std::make_shared<const Texture>(std::move(texture));
}

}  // namespace

bool KeepImageBytes(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                    const unsigned char* bytes, int size, void*) {
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

std::optional<int> UvSetOf(const std::filesystem::path& file, const tinygltf::Material& material) {
  std::optional<int> set;
  for (const Use& use : UsesOf(material)) {
    if (use.texture < 0) continue;
    if (use.extensions->contains("KHR_texture_transform")) {
      Refuse(file, material,
             {FaultKind::kUnsupported,
              "moves a texture by KHR_texture_transform, which is not drawn; apply it to the "
              "coordinates and export again"});
    }
    if (set && *set != use.uv_set) {
      Refuse(file, material,
             {FaultKind::kUnsupported,
              fmt::format("has textures on coordinates {} and {}; need one set of coordinates for "
                          "all textures of a material",
                          *set, use.uv_set)});
    }
    set = use.uv_set;
  }
  return set;
}

MaterialTextures ReadTextures(const std::filesystem::path& file, const tinygltf::Model& model,
                              const tinygltf::Material& material, Textures* known) {
  const auto read = [&](int index) { return Read(file, model, material, index, known); };
  const std::array<Use, 5> uses = UsesOf(material);
  MaterialTextures textures;
  textures.base_colour = read(uses[0].texture);
  textures.metallic_roughness = read(uses[1].texture);
  textures.normal = read(uses[2].texture);
  textures.occlusion = read(uses[3].texture);
  textures.emissive = read(uses[4].texture);
  textures.normal_scale = material.normalTexture.scale;
  textures.occlusion_strength = material.occlusionTexture.strength;
  return textures;
}

}  // namespace tera
