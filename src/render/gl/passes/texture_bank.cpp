#include "render/gl/passes/texture_bank.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace tera {
namespace {

constexpr float kMostAnisotropy = 8;  ///< textured faces often appear at grazing angles
constexpr unsigned kFirstUnit = 10;   ///< first texture unit; other passes use the units below

GLint ModeOf(Texture::Wrap wrap) {
  if (wrap == Texture::Wrap::kMirror) return GL_MIRRORED_REPEAT;
  return wrap == Texture::Wrap::kClamp ? GL_CLAMP_TO_EDGE : GL_REPEAT;
}

}  // namespace

unsigned TextureBank::Upload(const std::shared_ptr<const Texture>& texture, Coding coding) {
  if (!texture) return 0;
  const bool srgb = coding == Coding::kSrgb;
  GlObject& entry = textures_[texture->name + (srgb ? " sRGB" : " linear")];
  if (entry) return entry.id();
  const int side_px = std::max(texture->width_px, texture->height_px);
  const int levels = std::bit_width(static_cast<unsigned>(side_px));
  entry = MakeTexture(srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, texture->width_px, texture->height_px,
                      Filter::kLinear, Wrap::kRepeat, levels);
  const GLuint id = entry.id();
  glTextureSubImage2D(id, 0, 0, 0, texture->width_px, texture->height_px, GL_RGBA, GL_UNSIGNED_BYTE,
                      texture->rgba.data());
  glGenerateTextureMipmap(id);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, ModeOf(texture->wrap_x));
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, ModeOf(texture->wrap_y));
  if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
    glTextureParameterf(id, GL_TEXTURE_MAX_ANISOTROPY_EXT, kMostAnisotropy);
  }
  return id;
}

int TextureBank::Add(const Material& material) {
  const MaterialTextures& textures = material.textures;
  const bool gives_light = material.emission.maxCoeff() > 0;
  if (!textures.any() && !gives_light) return kPlain;
  Look look;
  look.base_colour = Upload(textures.base_colour, Coding::kSrgb);
  look.metallic_roughness = Upload(textures.metallic_roughness, Coding::kLinear);
  look.normal = Upload(textures.normal, Coding::kLinear);
  look.occlusion = Upload(textures.occlusion, Coding::kLinear);
  look.emissive = Upload(textures.emissive, Coding::kSrgb);
  look.emission = material.emission.cast<float>();
  look.normal_scale = static_cast<float>(textures.normal_scale);
  look.occlusion_strength = static_cast<float>(textures.occlusion_strength);
  look.gives_light = gives_light;
  looks_.push_back(look);
  return static_cast<int>(looks_.size()) - 1;
}

void TextureBank::Bind(int number, const Program& program) const {
  const Look& look = looks_[number];
  const std::array<std::pair<const char*, unsigned>, 5> maps = {
      {{"u_base_colour", look.base_colour},
       {"u_metallic_roughness", look.metallic_roughness},
       {"u_normal_map", look.normal},
       {"u_occlusion_map", look.occlusion},
       {"u_emissive_map", look.emissive}}};
  int present = 0;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const unsigned unit = kFirstUnit + static_cast<unsigned>(k);
    program.Set(maps[k].first, static_cast<int>(unit));
    if (maps[k].second == 0) continue;
    glBindTextureUnit(unit, maps[k].second);
    present |= 1 << k;
  }
  program.Set("u_maps", present);
  program.Set("u_normal_scale", look.normal_scale);
  program.Set("u_occlusion_strength", look.occlusion_strength);
  program.Set("u_emission", look.emission);
}

}  // namespace tera
