#pragma once

#include <string>

#include "diagnose/diagnosis.h"

// Figures of a report as HTML: <figure> with inline SVG and a caption.

namespace tera {

/// Measured and predicted values, without findings and with all findings. The window is the worst
/// interval of a location, or its worst 10 s. Predictions are measurements minus residuals, so they
/// include the fitted nuisances (likelihood.h).
std::string PredictionFigure(const DiagnosedBlock& diagnosed, const Location& location);

/// Residual without findings and with all findings, over the whole recording.
std::string ResidualFigure(const DiagnosedBlock& diagnosed, const Location& location);

/// An error as a function of a variable, with its band. `error` names the error and starts a
/// sentence.
std::string RegimeFigure(const DiagnosedBlock& diagnosed, const Location& location,
                         const Regime& regime, const std::string& error);

/// The levers that move, over time.
std::string LeversFigure(const NextManoeuvre& next);

/// Map of measured minus simulated ground. Empty without a difference.
std::string GroundFigure(const GroundMap& map);

}  // namespace tera
