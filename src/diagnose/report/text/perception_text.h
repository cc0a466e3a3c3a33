#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

/// Findings of lidars and cameras in sentences.

namespace tera {

/// "Lidar roof: range bias 0.050 ± 0.001 m (chosen with p < 0.0001, confirmed with p 0.001).
/// Held-out distance to the simulated surfaces 4.8 → 1.1 cm."
std::string SentenceOf(const PerceptionDiagnosis& diagnosis, const PerceptionFinding& found);

/// "The ground at (7.0, -2.0) m, 2.0 x 2.0 m, 2.0–9.0 s lies 0.4 m lower on average than in the
/// scenario.": sentence of a finding in the scene, with its place.
std::string PlainSceneText(const PerceptionFinding& found);

/// One sentence for each finding. Then for each sensor: unconfirmed mechanisms, the absence of
/// findings, or the reason why it was not judged.
std::vector<std::string> PerceptionSentences(const std::vector<PerceptionDiagnosis>& sensors);

}  // namespace tera
