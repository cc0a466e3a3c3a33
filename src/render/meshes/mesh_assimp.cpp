#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>

#include "core/error.h"
#include "render/meshes/mesh_file.h"
#include "render/meshes/picture_file.h"

namespace tera {
namespace {

[[noreturn]] void Refuse(const std::filesystem::path& file, const std::string& finding) {
  throw InputError(file.string(), {FaultKind::kMalformed, finding});
}

/// File system for assimp that also records the opened paths.
class NotingFiles : public Assimp::DefaultIOSystem {
 public:
  explicit NotingFiles(std::vector<std::filesystem::path>* read) : read_(*read) {}
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    Assimp::IOStream* stream = DefaultIOSystem::Open(path, mode);
    const bool again = std::find(read_.begin(), read_.end(), path) != read_.end();
    if (stream != nullptr && !again) read_.emplace_back(path);
    return stream;
  }

 private:
  std::vector<std::filesystem::path>& read_;
};

const aiScene* ReadScene(const std::filesystem::path& file, Assimp::Importer* importer) {
  // Drops points and lines, so that all remaining faces are triangles.
  importer->SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_LINE | aiPrimitiveType_POINT);
  // Ignores the up axis that a file declares, so that coordinates stay unchanged.
  importer->SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene =
      importer->ReadFile(file.string(), aiProcess_Triangulate | aiProcess_SortByPType |
                                            aiProcess_JoinIdenticalVertices | aiProcess_FlipUVs);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    Refuse(file, fmt::format("not a readable mesh ({}); need glTF, OBJ, STL or DAE",
                             importer->GetErrorString()));
  }
  return scene;
}

Material ReadMaterial(const std::filesystem::path& file, const aiMaterial& source,
                      Textures* textures) {
  Material material;
  aiString picture;
  if (source.GetTexture(aiTextureType_DIFFUSE, 0, &picture) == aiReturn_SUCCESS) {
    material.textures.base_colour =
        ReadPictureFile(file, source.GetName().C_Str(), picture.C_Str(), textures);
  }
  aiColor3D colour;
  if (source.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) {
    material.albedo = {colour.r, colour.g, colour.b};
  }
  float opacity = 1.0f;
  if (source.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) material.opacity = opacity;
  return material;
}

Eigen::Affine3f ToEigen(const aiMatrix4x4& m) {
  Eigen::Affine3f X;
  X.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return X;
}

/// Adds texture coordinates if the part has a texture.
void AddUvs(const std::filesystem::path& file, const aiMesh& source, MeshPart* part) {
  if (!part->material.textures.any()) return;
  if (!source.HasTextureCoords(0)) {
    Refuse(file, fmt::format("has triangles of mesh '{}', whose material has a picture, without "
                             "texture coordinates; export it again with them",
                             source.mName.C_Str()));
  }
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const aiVector3D& uv = source.mTextureCoords[0][i];
    part->uvs.emplace_back(uv.x, uv.y);
  }
}

/// Data common to all parts of a file.
struct Source {
  const std::filesystem::path& file;
  const aiScene& scene;
  Textures* textures;
};

void AddNode(const Source& from, const aiNode& node, const Eigen::Affine3f& X_root_parent,
             bool is_root, Mesh* mesh) {
  const Eigen::Affine3f X = is_root ? X_root_parent : X_root_parent * ToEigen(node.mTransformation);
  const Eigen::Matrix3f normal_map = X.linear().inverse().transpose();
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& source = *from.scene.mMeshes[node.mMeshes[m]];
    MeshPart part;
    part.material =
        ReadMaterial(from.file, *from.scene.mMaterials[source.mMaterialIndex], from.textures);
    AddUvs(from.file, source, &part);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      const aiVector3D& p = source.mVertices[i];
      part.positions_m.push_back(X * Eigen::Vector3f(p.x, p.y, p.z));
      if (!source.HasNormals()) continue;
      const aiVector3D& n = source.mNormals[i];
      part.normals.push_back(normal_map * Eigen::Vector3f(n.x, n.y, n.z));
    }
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
      const aiFace& face = source.mFaces[f];
      if (face.mNumIndices != 3) continue;
      part.indices.insert(part.indices.end(), face.mIndices, face.mIndices + 3);
    }
    mesh->parts.push_back(std::move(part));
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    AddNode(from, *node.mChildren[c], X, false, mesh);
  }
}

void CollectNames(const aiNode& node, std::vector<std::string>* names) {
  names->push_back(node.mName.C_Str());
  for (unsigned c = 0; c < node.mNumChildren; ++c) CollectNames(*node.mChildren[c], names);
}

}  // namespace

Mesh LoadWithAssimp(const std::filesystem::path& file, const std::string& node, Textures* textures,
                    NodeFrame frame) {
  Mesh mesh;
  Assimp::Importer importer;
  importer.SetIOHandler(new NotingFiles(&mesh.files));  // the importer deletes it
  const aiScene* scene = ReadScene(file, &importer);
  const aiNode* start = scene->mRootNode;
  if (!node.empty()) {
    start = scene->mRootNode->FindNode(node.c_str());
    if (start == nullptr) {
      std::vector<std::string> names;
      CollectNames(*scene->mRootNode, &names);
      throw InputError(
          file.string(),
          {FaultKind::kNoSuchName, fmt::format("has no node '{}'{}", node, NodeHint(node, names))});
    }
  }
  Eigen::Affine3f X = Eigen::Affine3f::Identity();
  if (frame == NodeFrame::kScene && !node.empty()) {
    for (const aiNode* at = start; at != nullptr; at = at->mParent) {
      X = ToEigen(at->mTransformation) * X;
    }
  }
  AddNode({file, *scene, textures}, *start, X, !node.empty(), &mesh);
  for (unsigned m = 0; m < scene->mNumMaterials; ++m) {
    aiString picture;
    if (scene->mMaterials[m]->GetTexture(aiTextureType_DIFFUSE, 0, &picture) != aiReturn_SUCCESS) {
      continue;
    }
    const std::filesystem::path read = file.parent_path() / picture.C_Str();
    if (textures->contains(read.string())) mesh.files.push_back(read);
  }
  FinishMesh(file, &mesh);
  return mesh;
}

}  // namespace tera
