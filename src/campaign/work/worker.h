#pragma once

#include "campaign/plan/plan.h"
#include "render/gl/egl_options.h"

namespace tera {

struct WorkerOptions {
  int threads = 1;  ///< the bytes do not depend on it
  EglOptions egl;
};

/// Makes one episode, the same whenever, wherever and however often it is tried. An episode that is
/// there is left as it is, and one that was killed goes on.
///
/// Model   an episode is made in work/ and renamed when it is whole, with its record. Bad input, a
///         bug and refusals by the rules leave a failure in failed/; an obstacle of the computer (a
///         disk, a driver, a file that cannot be read) leaves none.
/// Throws  InputError.
void RunEpisode(const Plan& plan, int number, const WorkerOptions& options);

}  // namespace tera
