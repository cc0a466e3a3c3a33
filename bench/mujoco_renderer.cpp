#include "mujoco_renderer.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>

#include "core/check.h"

namespace tera::bench {
namespace {

constexpr double kFar_m = 200;
constexpr int kShadowSide_px = 1846;  ///< squared, TERA's 1536 and 1024 squared
constexpr const char* kFileName = "scene.xml";

std::string Text(const Vec3& v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v.x(), v.y(), v.z()); }

std::string Quaternion(const Mat3& R) {
  const Eigen::Quaterniond q(R);
  return fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}", q.w(), q.x(), q.y(), q.z());
}

/// A mesh of one part, each triangle with corners of its own: MuJoCo refuses surfaces that pass an
/// edge twice the same way.
std::string MeshOf(const MeshPart& part, const std::string& name) {
  std::string vertices, faces;
  for (std::size_t k = 0; k < part.indices.size(); ++k) {
    vertices += Text(part.positions_m[part.indices[k]].cast<double>()) + " ";
    faces += fmt::format("{} ", k);
  }
  return fmt::format("<mesh name='{}' vertex='{}' face='{}'/>", name, vertices, faces);
}

bool IsDrawn(const MeshPart& part) {
  constexpr std::size_t kLeastCorners = 4;  // that MuJoCo takes
  return part.material.opacity >= 1 && part.indices.size() >= kLeastCorners;
}

std::string Assets(const SceneModel& scene, const TerrainSurface& ground, int stride) {
  std::string text =
      "<texture type='skybox' builtin='gradient' rgb1='0.5 0.65 0.9' rgb2='0.8 0.85 0.9' "
      "width='256' height='256'/>";
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const std::vector<MeshPart>& parts = scene.meshes[m].parts;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (IsDrawn(parts[p])) text += MeshOf(parts[p], fmt::format("mesh{}_{}", m, p));
    }
  }
  const int columns = (ground.nx - 1) / stride + 1, rows = (ground.ny - 1) / stride + 1;
  const double half_x_m = 0.5 * (columns - 1) * stride * ground.cell_m,
               half_y_m = 0.5 * (rows - 1) * stride * ground.cell_m;
  text += fmt::format("<hfield name='ground' nrow='{}' ncol='{}' size='{} {} 1 0.1'/>", rows,
                      columns, half_x_m, half_y_m);
  return text;
}

std::string Geoms(const SceneModel& scene, int body) {
  std::string text;
  for (const SceneNode& node : scene.nodes) {
    if (node.body != body || node.shape >= 0 || node.scale != 1.0) continue;
    const std::vector<MeshPart>& parts = scene.meshes[node.mesh].parts;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (!IsDrawn(parts[p])) continue;
      const Vec3 rgb = parts[p].material.albedo.cwiseMax(0.0).cwiseSqrt();
      text += fmt::format(
          "<geom type='mesh' mesh='mesh{}_{}' shellinertia='true' contype='0' conaffinity='0' "
          "pos='{}' quat='{}' rgba='{} 1'/>",
          node.mesh, p, Text(node.X_BG.translation()), Quaternion(node.X_BG.linear()), Text(rgb));
    }
  }
  return text;
}

std::string SceneXml(const SceneModel& scene, const TerrainSurface& ground, int stride,
                     const std::set<int>& bodies, int width_px, int height_px) {
  const Vec2 middle_m =
      ground.origin_W_m + 0.5 * ground.cell_m * Vec2(ground.nx - 1, ground.ny - 1);
  std::string text = fmt::format(
      "<mujoco><compiler angle='radian'/><size nstack='20000000'/><visual><global "
      "offwidth='{}' offheight='{}'/><quality shadowsize='{}' offsamples='0'/></visual><asset>{}"
      "</asset><worldbody><light directional='true' castshadow='true' dir='{}' pos='{}'/>"
      "<geom type='hfield' hfield='ground' pos='{} {} 0' rgba='0.55 0.45 0.35 1' contype='0' "
      "conaffinity='0'/>",
      width_px, height_px, kShadowSide_px, Assets(scene, ground, stride),
      Text(-scene.environment.to_sun_W), Text(30 * scene.environment.to_sun_W), middle_m.x(),
      middle_m.y());
  for (const int body : bodies) {
    text += fmt::format("<body name='b{}' mocap='true'>{}</body>", body, Geoms(scene, body));
  }
  return text + "</worldbody></mujoco>";
}

MujocoModel Compiled(const std::string& xml) {
  mjVFS files;
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, kFileName, static_cast<int>(xml.size()));
  xml.copy(static_cast<char*>(files.filedata[0]), xml.size());
  char error[1000] = "";
  MujocoModel model(mj_loadXML(kFileName, &files, error, sizeof error));
  mj_deleteVFS(&files);
  if (!model) throw std::runtime_error(fmt::format("MuJoCo refuses the scene: {}", error));
  return model;
}

/// Heights over the field's own size along z, 1 m.
void FillGround(const TerrainSurface& ground, int stride, mjModel* model) {
  for (int row = 0; row < model->hfield_nrow[0]; ++row) {
    for (int column = 0; column < model->hfield_ncol[0]; ++column) {
      model->hfield_data[row * model->hfield_ncol[0] + column] =
          ground.height_m(column * stride, row * stride);
    }
  }
}

}  // namespace

/// A context of the compatibility profile, which MuJoCo draws with.
struct MujocoRenderer::Gl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  Gl() {
    display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    EGLint major = 0, minor = 0;
    TERA_CHECK(eglInitialize(display, &major, &minor), eglGetError());
    eglBindAPI(EGL_OPENGL_API);
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
    TERA_CHECK(context != EGL_NO_CONTEXT, eglGetError());
    Take();
  }
  ~Gl() { eglDestroyContext(display, context); }
  void Take() const {
    eglBindAPI(EGL_OPENGL_API);
    TERA_CHECK(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context), eglGetError());
  }
  void Release() const { eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
};

MujocoRenderer::MujocoRenderer(const SceneModel& scene, const TerrainSurface& ground, int width_px,
                               int height_px)
    : gl_(std::make_unique<Gl>()),
      rgb_(width_px, height_px, 3),
      segments_(width_px, height_px, 3),
      depth_(width_px, height_px) {
  std::set<int> bodies;
  for (const SceneNode& node : scene.nodes) bodies.insert(node.body);
  body_of_mocap_.assign(bodies.begin(), bodies.end());
  model_ = Compiled(SceneXml(scene, ground, kGroundStride, bodies, width_px, height_px));
  FillGround(ground, kGroundStride, model_.get());
  data_.reset(mj_makeData(model_.get()));
  mjv_defaultOption(&option_);
  mjv_defaultScene(&scene_);
  mjv_makeScene(model_.get(), &scene_, model_->ngeom + 100);
  mjr_defaultContext(&context_);
  mjr_makeContext(model_.get(), &context_, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
  for (int g = 0; g < model_->ngeom; ++g) {
    if (model_->geom_type[g] == mjGEOM_MESH)
      triangles_ += model_->mesh_facenum[model_->geom_dataid[g]];
  }
  triangles_ += 2ll * (model_->hfield_nrow[0] - 1) * (model_->hfield_ncol[0] - 1);
  gl_->Release();
}

MujocoRenderer::~MujocoRenderer() {
  gl_->Take();
  mjr_freeContext(&context_);
  mjv_freeScene(&scene_);
  gl_->Release();
}

void MujocoRenderer::Render(const CameraIntrinsics& camera, const Pose& X_WC,
                            const SceneState& state, Output output) {
  gl_->Take();
  for (std::size_t k = 0; k < body_of_mocap_.size(); ++k) {
    const Pose& X_WB = state.X_WB[static_cast<std::size_t>(body_of_mocap_[k])];
    const Eigen::Quaterniond q(X_WB.linear());
    const std::array<double, 4> quaternion = {q.w(), q.x(), q.y(), q.z()};
    std::copy_n(X_WB.translation().data(), 3, data_->mocap_pos + 3 * k);
    std::copy_n(quaternion.data(), 4, data_->mocap_quat + 4 * k);
  }
  mj_kinematics(model_.get(), data_.get());
  mj_camlight(model_.get(), data_.get());
  mjvCamera from;
  mjv_defaultCamera(&from);
  mjv_updateScene(model_.get(), data_.get(), &option_, nullptr, &from, mjCAT_ALL, &scene_);
  for (mjvGLCamera& eye : scene_.camera) {
    for (int k = 0; k < 3; ++k) {
      eye.pos[k] = static_cast<float>(X_WC.translation()[k]);
      eye.forward[k] = static_cast<float>(X_WC.linear()(k, 2));
      eye.up[k] = static_cast<float>(-X_WC.linear()(k, 1));
    }
    const double top = camera.near_m * (camera.cy_px + 0.5) / camera.fy_px;
    eye.frustum_near = static_cast<float>(camera.near_m);
    eye.frustum_far = static_cast<float>(kFar_m);
    eye.frustum_center = 0;
    eye.frustum_top = static_cast<float>(top);
    eye.frustum_bottom = static_cast<float>(top - camera.near_m * camera.height_px / camera.fy_px);
  }
  const mjrRect picture = {0, 0, rgb_.width_px, rgb_.height_px};
  mjr_render(picture, &scene_, &context_);
  mjr_readPixels(rgb_.data.data(), depth_.data.data(), picture, &context_);
  if (output == Output::kAndSegments) {
    scene_.flags[mjRND_SEGMENT] = scene_.flags[mjRND_IDCOLOR] = 1;
    mjr_render(picture, &scene_, &context_);
    mjr_readPixels(segments_.data.data(), nullptr, picture, &context_);
    scene_.flags[mjRND_SEGMENT] = scene_.flags[mjRND_IDCOLOR] = 0;
  }
  gl_->Release();
}

}  // namespace tera::bench
