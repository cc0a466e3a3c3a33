#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "render/meshes/gltf_textures.h"
#include "render/meshes/mesh_file.h"
#include "render/meshes/picture_file.h"

namespace tera {
namespace {

constexpr int kMaxNodeDepth = 100;

[[noreturn]] void RefuseGltf(const std::filesystem::path& file, const std::string& finding) {
  throw InputError(file.string(), {FaultKind::kMalformed, finding});
}

/// File reader for tinygltf that also appends the path to the list at `read`.
bool ReadAndNote(std::vector<unsigned char>* bytes, std::string* error, const std::string& path,
                 void* read) {
  static_cast<std::vector<std::filesystem::path>*>(read)->emplace_back(path);
  return tinygltf::ReadWholeFile(bytes, error, path, nullptr);
}

/// Parses the file. `read` receives the paths of all files of the model.
tinygltf::Model ReadModel(const std::filesystem::path& file,
                          std::vector<std::filesystem::path>* read) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(KeepImageBytes, nullptr);
  loader.SetFsCallbacks({.FileExists = tinygltf::FileExists,
                         .ExpandFilePath = tinygltf::ExpandFilePath,
                         .ReadWholeFile = ReadAndNote,
                         .WriteWholeFile = nullptr,
                         .user_data = read});
  tinygltf::Model model;
  std::string error, warning;
  const bool binary = file.extension() == ".glb";
  const bool ok = binary ? loader.LoadBinaryFromFile(&model, &error, &warning, file.string())
                         : loader.LoadASCIIFromFile(&model, &error, &warning, file.string());
  if (!ok) {
    while (!error.empty() && std::isspace(static_cast<unsigned char>(error.back()))) {
      error.pop_back();
    }
    RefuseGltf(file, fmt::format("not a readable glTF 2.0 file ({}); export it again",
                                 error.empty() ? "no reason given" : error));
  }
  return model;
}

/// Bounds-checked access to the numbers of a glTF accessor.
class Accessor {
 public:
  Accessor(const std::filesystem::path& file, const tinygltf::Model& model, int index)
      : file_(file) {
    if (index < 0 || index >= static_cast<int>(model.accessors.size())) {
      RefuseGltf(file, fmt::format("names accessor {}, which does not exist", index));
    }
    accessor_ = &model.accessors[index];
    if (accessor_->sparse.isSparse || accessor_->bufferView < 0 ||
        accessor_->bufferView >= static_cast<int>(model.bufferViews.size())) {
      RefuseGltf(file, "has a sparse or empty accessor; export it with plain buffers");
    }
    const tinygltf::BufferView& view = model.bufferViews[accessor_->bufferView];
    const int stride = accessor_->ByteStride(view);
    const int element = tinygltf::GetComponentSizeInBytes(accessor_->componentType) *
                        tinygltf::GetNumComponentsInType(accessor_->type);
    if (view.buffer < 0 || view.buffer >= static_cast<int>(model.buffers.size()) || stride <= 0) {
      RefuseGltf(file, "has a buffer view without a buffer");
    }
    const std::vector<unsigned char>& data = model.buffers[view.buffer].data;
    const std::size_t begin = view.byteOffset + accessor_->byteOffset;
    const std::size_t need = accessor_->count == 0 ? 0 : (accessor_->count - 1) * stride + element;
    if (begin > data.size() || need > data.size() - begin) {
      RefuseGltf(file, "is cut short: an accessor reaches beyond its buffer; export it again");
    }
    first_ = data.data() + begin;
    stride_ = static_cast<std::size_t>(stride);
  }

  std::size_t count() const { return accessor_->count; }

  /// Texture coordinates from any of glTF's three number formats.
  Eigen::Vector2f Uv(std::size_t i) const {
    if (accessor_->type != TINYGLTF_TYPE_VEC2)
      RefuseGltf(file_, "has coordinates that are not pairs");
    const unsigned char* at = first_ + i * stride_;
    const auto pair = [&]<typename T>(T scale) {
      std::array<T, 2> v;
      std::memcpy(v.data(), at, sizeof(v));
      return Eigen::Vector2f(static_cast<float>(v[0]) / static_cast<float>(scale),
                             static_cast<float>(v[1]) / static_cast<float>(scale));
    };
    switch (accessor_->componentType) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return pair(1.0f);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return pair(std::numeric_limits<std::uint8_t>::max());
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return pair(std::numeric_limits<std::uint16_t>::max());
      default:
        RefuseGltf(file_, "has coordinates that are not floats or unsigned integers");
    }
  }

  Eigen::Vector3f Vector3(std::size_t i) const {
    if (accessor_->componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        accessor_->type != TINYGLTF_TYPE_VEC3) {
      RefuseGltf(file_, "has positions or normals that are not three floats");
    }
    Eigen::Vector3f v;
    std::memcpy(v.data(), first_ + i * stride_, sizeof(float) * 3);
    return v;
  }

  std::uint32_t Index(std::size_t i) const {
    const unsigned char* at = first_ + i * stride_;
    switch (accessor_->componentType) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *at;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
        std::uint16_t value;
        std::memcpy(&value, at, sizeof(value));
        return value;
      }
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
        std::uint32_t value;
        std::memcpy(&value, at, sizeof(value));
        return value;
      }
      default:
        RefuseGltf(file_, "has indices that are not unsigned integers");
    }
  }

 private:
  const std::filesystem::path& file_;
  const tinygltf::Accessor* accessor_ = nullptr;
  const unsigned char* first_ = nullptr;
  std::size_t stride_ = 0;
};

Material ReadMaterial(const std::filesystem::path& file, const tinygltf::Model& model, int index,
                      Textures* textures) {
  Material material;
  if (index < 0 || index >= static_cast<int>(model.materials.size())) return material;
  const tinygltf::PbrMetallicRoughness& pbr = model.materials[index].pbrMetallicRoughness;
  const std::vector<double>& emission = model.materials[index].emissiveFactor;
  material.emission = {emission[0], emission[1], emission[2]};
  material.textures = ReadTextures(file, model, model.materials[index], textures);
  const std::vector<double>& colour = pbr.baseColorFactor;
  material.albedo = {colour[0], colour[1], colour[2]};
  if (model.materials[index].alphaMode == "BLEND") material.opacity = colour[3];
  material.roughness = pbr.roughnessFactor;
  material.metallic = pbr.metallicFactor;
  const tinygltf::Value& extras = model.materials[index].extras;
  if (extras.IsObject() && extras.Has("lidar_reflectance") &&
      extras.Get("lidar_reflectance").IsNumber()) {
    material.lidar_reflectance = extras.Get("lidar_reflectance").GetNumberAsDouble();
  }
  return material;
}

/// Pose and scale of a node in its parent, in the file's y-up axes.
Eigen::Affine3d NodeTransform(const tinygltf::Node& node) {
  Eigen::Affine3d X = Eigen::Affine3d::Identity();
  if (node.matrix.size() == 16) {
    X.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    return X;
  }
  if (node.translation.size() == 3) {
    X.translate(Eigen::Map<const Vec3>(node.translation.data()));
  }
  if (node.rotation.size() == 4) {
    X.rotate(
        Quat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]).normalized());
  }
  if (node.scale.size() == 3) X.scale(Eigen::Map<const Vec3>(node.scale.data()));
  return X;
}

struct Reader {
  const std::filesystem::path& file;
  const tinygltf::Model& model;
  Mesh* mesh;
  Textures* textures;

  /// Rotation from the file's y-up axes to z-up axes: p = (x, -z, y).
  static Mat3 ZUp() {
    Mat3 R;
    R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    return R;
  }

  void AddPrimitive(const tinygltf::Primitive& primitive, const Eigen::Affine3d& X) {
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) return;
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
      RefuseGltf(file, "has a primitive without positions");
    }
    const Eigen::Affine3f X_up((Eigen::Affine3d(ZUp()) * X).cast<float>());
    const Eigen::Matrix3f normal_map = X_up.linear().inverse().transpose();
    MeshPart part;
    part.material = ReadMaterial(file, model, primitive.material, textures);
    const Accessor positions(file, model, position->second);
    for (std::size_t i = 0; i < positions.count(); ++i) {
      part.positions_m.push_back(X_up * positions.Vector3(i));
    }
    if (primitive.indices >= 0) {
      const Accessor indices(file, model, primitive.indices);
      for (std::size_t i = 0; i < indices.count(); ++i) part.indices.push_back(indices.Index(i));
    } else {
      for (std::uint32_t i = 0; i < positions.count(); ++i) part.indices.push_back(i);
    }
    const auto normal = primitive.attributes.find("NORMAL");
    if (normal != primitive.attributes.end()) {
      const Accessor normals(file, model, normal->second);
      for (std::size_t i = 0; i < normals.count(); ++i) {
        part.normals.push_back(normal_map * normals.Vector3(i));
      }
    }
    AddUvs(primitive, &part);
    mesh->parts.push_back(std::move(part));
  }

  /// Adds texture coordinates if the part has textures.
  void AddUvs(const tinygltf::Primitive& primitive, MeshPart* part) {
    if (!part->material.textures.any()) return;
    const tinygltf::Material& material = model.materials[primitive.material];
    const std::string name = fmt::format("TEXCOORD_{}", UvSetOf(file, material).value_or(0));
    const auto uv = primitive.attributes.find(name);
    if (uv == primitive.attributes.end()) {
      throw InputError(
          file.string(),
          {FaultKind::kMissing, fmt::format("has triangles of material '{}', which has textures, "
                                            "without {}; export it again with texture coordinates",
                                            material.name, name)});
    }
    const Accessor uvs(file, model, uv->second);
    for (std::size_t i = 0; i < uvs.count(); ++i) part->uvs.push_back(uvs.Uv(i));
    if (part->uvs.size() != part->positions_m.size()) {
      RefuseGltf(file, fmt::format("has {} texture coordinates for {} vertices; export it again",
                                   part->uvs.size(), part->positions_m.size()));
    }
  }

  void AddNode(int index, const Eigen::Affine3d& X_root_parent, bool is_root, int depth) {
    if (index < 0 || index >= static_cast<int>(model.nodes.size()) || depth > kMaxNodeDepth) {
      RefuseGltf(file, "has a broken node hierarchy; export it again");
    }
    const tinygltf::Node& node = model.nodes[index];
    const Eigen::Affine3d X = is_root ? X_root_parent : X_root_parent * NodeTransform(node);
    if (node.mesh >= 0) {
      if (node.mesh >= static_cast<int>(model.meshes.size())) {
        RefuseGltf(file, fmt::format("names mesh {}, which does not exist", node.mesh));
      }
      for (const tinygltf::Primitive& primitive : model.meshes[node.mesh].primitives) {
        AddPrimitive(primitive, X);
      }
    }
    for (int child : node.children) AddNode(child, X, false, depth + 1);
  }
};

std::vector<int> RootNodes(const tinygltf::Model& model) {
  if (!model.scenes.empty()) {
    const int wanted = model.defaultScene;
    const bool known = wanted >= 0 && wanted < static_cast<int>(model.scenes.size());
    return model.scenes[known ? wanted : 0].nodes;
  }
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (int child : node.children) {
      if (child >= 0 && child < static_cast<int>(is_child.size())) is_child[child] = true;
    }
  }
  std::vector<int> roots;
  for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i) {
    if (!is_child[i]) roots.push_back(i);
  }
  return roots;
}

std::vector<std::string> NamesOf(const tinygltf::Model& model) {
  std::vector<std::string> names;
  for (const tinygltf::Node& node : model.nodes) names.push_back(node.name);
  return names;
}

/// Pose of the node in its scene, in the file's y-up axes.
Eigen::Affine3d PlaceOf(const std::filesystem::path& file, const tinygltf::Model& model,
                        int index) {
  Eigen::Affine3d X = NodeTransform(model.nodes[index]);
  for (int depth = 0; depth <= kMaxNodeDepth; ++depth) {
    const auto parent =
        std::find_if(model.nodes.begin(), model.nodes.end(), [&](const tinygltf::Node& node) {
          return std::find(node.children.begin(), node.children.end(), index) !=
                 node.children.end();
        });
    if (parent == model.nodes.end()) return X;
    X = NodeTransform(*parent) * X;
    index = static_cast<int>(parent - model.nodes.begin());
  }
  RefuseGltf(file, "has a broken node hierarchy; export it again");
}

}  // namespace

Mesh LoadGltf(const std::filesystem::path& file, const std::string& node, Textures* textures,
              NodeFrame frame) {
  Mesh mesh;
  const tinygltf::Model model = ReadModel(file, &mesh.files);
  Reader reader{file, model, &mesh, textures};
  const Eigen::Affine3d identity = Eigen::Affine3d::Identity();
  if (node.empty()) {
    for (int root : RootNodes(model)) reader.AddNode(root, identity, false, 0);
  } else {
    const std::vector<std::string> names = NamesOf(model);
    const auto found = std::find(names.begin(), names.end(), node);
    if (found == names.end()) {
      throw InputError(
          file.string(),
          {FaultKind::kNoSuchName, fmt::format("has no node '{}'{}", node, NodeHint(node, names))});
    }
    const int index = static_cast<int>(found - names.begin());
    reader.AddNode(index, frame == NodeFrame::kScene ? PlaceOf(file, model, index) : identity, true,
                   0);
  }
  FinishMesh(file, &mesh);
  return mesh;
}

}  // namespace tera
