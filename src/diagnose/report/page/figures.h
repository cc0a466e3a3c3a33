#pragma once

#include <string>

#include "diagnose/diagnosis.h"

// The figures of a report, each as HTML: <figure> with inline SVG and a caption.

namespace tera {

/// Measured and predicted values, without terms and with all findings, over the worst interval of a
/// location, or its 10 s with the largest error. Predictions are measurements minus residuals, and
/// so include the fitted nuisances (likelihood.h).
std::string PredictionFigure(const DiagnosedBlock& diagnosed, const Location& location);

/// The residual without terms and with all findings, over the whole recording.
std::string ResidualFigure(const DiagnosedBlock& diagnosed, const Location& location);

/// An error as a function of a variable, with its band. `error` names the error, as the start of a
/// sentence.
std::string RegimeFigure(const DiagnosedBlock& diagnosed, const Location& location,
                         const Regime& regime, const std::string& error);

/// The levers that move, over time.
std::string LeversFigure(const NextManoeuvre& next);

/// A map of the measured ground over the simulated one; empty where they are the same.
std::string GroundFigure(const GroundMap& map);

}  // namespace tera
