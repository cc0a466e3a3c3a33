#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/types/surface_normal.h"
#include "dataset/lint/checks/picture_set.h"

// Checks the consistency of depth, normals and flow.

namespace tera {
namespace {

constexpr std::uint8_t kSky = static_cast<std::uint8_t>(SemanticClass::kSky);
/// Depth and distance are rounded to whole millimetres.
constexpr int kRounding_mm = 2;
/// Noise of a depth camera may put some pixels behind the surface, but not most.
constexpr double kMostBehind = 0.5;
/// Rounding to 1/32767 on three axes causes 2.6e-5. The shader computes in single precision.
constexpr double kNormalTolerance = 1e-4;
constexpr std::uint16_t kLastFlowState = 3;

void CheckSky(LintJob* job, const PictureSet& set, std::string_view folder,
              const Image<std::uint16_t>& picture) {
  if (picture.empty() || set.frame.semantic.empty()) return;
  job->Applies("pictures.depth");
  std::int64_t wrong = 0;
  for (std::size_t i = 0; i < picture.data.size(); ++i) {
    wrong += picture.data[i] != 0 && set.frame.semantic.data[i] == kSky ? 1 : 0;
  }
  if (wrong == 0) return;
  job->Find("pictures.depth", set.camera,
            set.In(folder, fmt::format("{} sky pixels have a depth or distance", wrong)));
}

void CheckDistance(LintJob* job, const PictureSet& set) {
  if (set.depth_mm.empty() || set.frame.distance.empty()) return;
  job->Applies("pictures.depth");
  std::int64_t both = 0, behind = 0;
  for (std::size_t i = 0; i < set.depth_mm.data.size(); ++i) {
    const int depth = set.depth_mm.data[i], distance = set.frame.distance.data[i];
    if (depth == 0 || distance == 0) continue;
    ++both;
    behind += depth > distance + kRounding_mm ? 1 : 0;
  }
  if (static_cast<double>(behind) <= kMostBehind * static_cast<double>(both)) return;
  job->Find(
      "pictures.depth", set.camera,
      set.In("depth", fmt::format("{} of {} pixels have more depth than distance", behind, both)));
}

void CheckNormals(LintJob* job, const PictureSet& set) {
  const Image<std::uint16_t>& normal = set.frame.normal;
  if (normal.empty()) return;
  job->Applies("pictures.normals");
  std::int64_t wrong = 0;
  for (std::size_t i = 0; i + 2 < normal.data.size(); i += 3) {
    const std::uint16_t* v = &normal.data[i];
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) continue;
    const Vec3 n = Vec3(v[0], v[1], v[2]) / 32767.0 - Vec3::Ones();
    wrong += std::abs(n.norm() - 1) > kNormalTolerance ? 1 : 0;
  }
  if (wrong == 0) return;
  job->Find("pictures.normals", set.camera,
            set.In("normal", fmt::format("{} normals are not of length 1", wrong)));
}

void CheckFlow(LintJob* job, const PictureSet& set, std::string_view folder,
               const Image<std::uint16_t>& flow, bool has_states) {
  if (flow.empty()) return;
  job->Applies("pictures.flow");
  const auto moves = [](std::uint16_t value) { return value != 0; };
  if (set.is_first && std::any_of(flow.data.begin(), flow.data.end(), moves)) {
    job->Find("pictures.flow", set.camera,
              set.In(folder, "the first picture has flow, but no picture precedes it"));
  }
  if (!has_states) return;
  std::int64_t wrong = 0;
  for (std::size_t i = 2; i < flow.data.size(); i += 3) wrong += flow.data[i] > kLastFlowState;
  if (wrong == 0) return;
  job->Find(
      "pictures.flow", set.camera,
      set.In(folder, fmt::format("{} pixels have a third value above {}", wrong, kLastFlowState)));
}

}  // namespace

void CheckSurfaces(LintJob* job, const PictureSet& set) {
  CheckSky(job, set, "depth", set.depth_mm);
  CheckSky(job, set, "distance", set.frame.distance);
  CheckDistance(job, set);
  CheckNormals(job, set);
  CheckFlow(job, set, "flow_to_previous", set.frame.flow_to_previous, true);
  CheckFlow(job, set, "flow_to_this", set.frame.flow_to_this, true);
  CheckFlow(job, set, "scene_flow_to_previous", set.frame.scene_flow_to_previous, false);
  RangeHistogram& depths = job->statistics().depth_m;
  for (const std::uint16_t mm : set.depth_mm.data) {
    if (mm != 0) ++depths[std::min<std::size_t>(mm / 1000, depths.size() - 1)];
  }
}

}  // namespace tera
