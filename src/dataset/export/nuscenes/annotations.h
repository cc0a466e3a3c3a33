#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dataset/export/nuscenes/nuscenes_rig.h"
#include "dataset/export/nuscenes/nuscenes_tables.h"

namespace tera {

/// An object in view of a machine's cameras at one time.
///
/// Frames  W world; O the object's box frame (x forward, y left, z up), origin in its centre.
struct AnnotatedObject {
  std::uint16_t instance = 0;
  SemanticClass label = SemanticClass::kSky;
  Pose X_WO = Pose::Identity();
  Vec3 size_O_m = Vec3::Zero();
  double visibility = 0;  ///< the maximum over the cameras
  std::int64_t lidar_points = 0;
};

/// Objects in the pictures nearest to `t_ns`, at most `most_apart_ns` from it. Only top-level
/// objects count, without the machine itself and its load.
///
/// Model   a box has the pose in W at the time of the picture. If the last picture before `t_ns`
///         and the first after it both have the box, its pose is interpolated linearly.
std::vector<AnnotatedObject> ObjectsAt(const Recording& recording, const NuScenesRig& rig,
                                       TimeNs t_ns, TimeNs most_apart_ns);

/// Counts the points of `points_W_m` in each object's box.
void CountPoints(const std::vector<Vec3>& points_W_m, std::vector<AnnotatedObject>* objects);

/// Writes the tables `sample_annotation` and `instance` of a scene. An annotation is written when
/// the next annotation of its object is known.
class AnnotationWriter {
 public:
  AnnotationWriter(const NuTokens& tokens, std::size_t scene, NuTables* tables)
      : tokens_(tokens), scene_(scene), tables_(tables) {}

  /// Samples come in order.
  void Add(std::int64_t sample, const std::vector<AnnotatedObject>& objects);
  void Finish();

 private:
  struct Track {
    OrderedJson last;
    std::string first_token, last_token;
    std::int64_t count = 0;
    SemanticClass label = SemanticClass::kSky;
  };

  const NuTokens& tokens_;
  std::size_t scene_;
  NuTables* tables_;
  std::map<std::uint16_t, Track> tracks_;
};

/// Token of a visibility level: up to 40, 60, 80 and 100 %.
std::string VisibilityToken(double visibility);

}  // namespace tera
