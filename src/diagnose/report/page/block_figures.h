#pragma once

#include <string>

#include "diagnose/diagnosis.h"

/// The figures of a report, each as HTML: <figure> with inline SVG and a caption.

namespace tera {

/// Measured and predicted, with nothing and with all that was found, over the worst interval of a
/// location: of a longer one the 30 s with the largest error. Predictions are the measurements less
/// the residuals, so that they have the fitted nuisances (likelihood.h) in them.
std::string PredictionFigure(const DiagnosedBlock& diagnosed, const Location& location);

/// The residual with nothing and with all that was found, over the whole recording.
std::string ResidualFigure(const DiagnosedBlock& diagnosed, const Location& location);

/// An error as a function of a variable, with its band. `error` says which, as a sentence begins.
std::string RegimeFigure(const DiagnosedBlock& diagnosed, const Location& location,
                         const Regime& regime, const std::string& error);

/// What each mechanism alone gains on held-out samples, and several that were found together.
std::string EvidenceFigure(const DiagnosedBlock& diagnosed);

/// The levers that move, over time.
std::string LeversFigure(const NextManoeuvre& next);

}  // namespace tera
