#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/layout_measures.h"
#include "layout/optimise/candidate.h"
#include "layout/optimise/search.h"
#include "layout/study/cycle.h"
#include "layout/study/study.h"

namespace tera {

/// Quality of a layout. All objectives are to be minimised. `beyond` is the violation of the
/// limits: the sum of each quantity's relative excess over its limit. A layout without a lidar or
/// camera counts as violating the limits.
struct Appraised {
  std::vector<double> objectives;  ///< figures to be maximised are negated
  double beyond = 0;
  bool is_allowed() const { return beyond <= 0; }
};

/// Evaluates candidate layouts at some moments of a cycle. The scenes of these moments stay in
/// memory, so a further layout costs only ray casts.
class Appraisal {
 public:
  /// Runs through the cycle once. Keeps references to all arguments.
  ///
  /// Throws  InputError if an objective is no figure, if a mount names no link of the machine, or
  ///         if a sensor has the name of a kept one. Also if a zone has no place in the air. Also
  ///         if the kept sensors alone, or every layout with at least one lidar or camera, violate
  ///         the limits. Also if the scenes of the moments need more than `most_bytes`; and as
  ///         Cycle does.
  Appraisal(const LayoutSearch& search, const LayoutStudy& study, const Cycle& cycle, int threads,
            std::int64_t most_bytes = HalfOfMemory());

  static std::int64_t HalfOfMemory();

  Appraised Of(const Genes& genes) const { return Of(Laid(genes)); }
  Appraised Of(Layout layout) const;
  Layout Laid(const Genes& genes) const;
  const std::vector<SensorDescription>& kept() const { return kept_; }
  /// For each objective: -1 if it is the negated figure, else 1.
  const std::vector<double>& signs() const { return signs_; }
  const StudiedMachine& studied() const { return studied_; }
  /// Warnings for mounts that are inside the machine at every tested place within their bounds.
  std::vector<std::string> Warnings() const;

 private:
  struct Moment {
    Instant now;
    TerrainSurface ground;
    std::unique_ptr<Sighting> sighting;
    Places places;
  };
  LayoutMeasures MeasuresOf(const Layout& layout) const;
  void RequirePlaces() const;
  void RequireFigures();
  void RequireRoom(std::int64_t most_bytes) const;
  void RequireWithinLimits() const;
  void RequireReachable() const;
  double LeastTaken(const char* name) const;
  double Beyond(const Layout& layout) const;
  std::optional<std::string> PartAround(const SensorSlot& slot, const MountBounds& mount) const;
  const MachineModel& model() const { return scenario_.machines[studied_.machine].placement.model; }

  const LayoutSearch& search_;
  const LayoutStudy& study_;
  const Scenario& scenario_;
  StudiedMachine studied_;
  SceneAssembly assembly_;
  std::vector<SensorDescription> kept_;
  std::vector<FigureId> wanted_;
  std::vector<double> signs_;
  std::vector<Moment> moments_;
};

}  // namespace tera
