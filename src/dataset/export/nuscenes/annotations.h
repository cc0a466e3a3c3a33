#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dataset/export/nuscenes/nuscenes_rig.h"
#include "dataset/export/nuscenes/nuscenes_tables.h"

namespace tera {

/// An object seen by the cameras of a machine at one time.
///
/// Frames  W world; O box frame of the object (x forward, y left, z up), with its origin at the box
///         centre.
struct AnnotatedObject {
  std::uint16_t instance = 0;
  SemanticClass label = SemanticClass::kSky;
  Pose X_WO = Pose::Identity();
  Vec3 size_O_m = Vec3::Zero();
  double visibility = 0;  ///< highest visibility among the cameras
  std::int64_t lidar_points = 0;
};

/// Objects in the images nearest to `t_ns`, at most `most_apart_ns` away. Parts of objects are
/// excluded, as are the machine itself and its load.
///
/// Model   The pose of a box in W is valid at the time of its image. If the last image before
///         `t_ns` and the first image after it both show the object, its pose is interpolated
///         linearly.
std::vector<AnnotatedObject> ObjectsAt(const Recording& recording, const NuScenesRig& rig,
                                       TimeNs t_ns, TimeNs most_apart_ns);

/// Counts the points inside the box of each object.
void CountPoints(const std::vector<Vec3>& points_W_m, std::vector<AnnotatedObject>* objects);

/// Writes the tables `sample_annotation` and `instance` of a scene. A row names the next annotation
/// of its object, so a row is written when the next annotation is known.
class AnnotationWriter {
 public:
  AnnotationWriter(const NuTokens& tokens, std::size_t scene, NuTables* tables)
      : tokens_(tokens), scene_(scene), tables_(tables) {}

  /// Samples must be added in order.
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

/// Token of the visibility level: up to 40, 60, 80 or 100 %.
std::string VisibilityToken(double visibility);

}  // namespace tera
