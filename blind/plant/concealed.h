#pragma once

#include <map>
#include <string>
#include <vector>

#include "blind/plant/excavator.h"
#include "blind/plant/plant.h"
#include "core/random.h"

namespace tera::blind {

/// Size of an effect.
enum class Strength { kStrong, kMedium, kFaint };
std::string_view NameOf(Strength strength);

/// An effect that the scenario does not contain.
struct Concealed {
  std::string target;                   ///< joint, or base
  std::string name;                     ///< the correct answer; empty: no name of the tool fits
  std::vector<std::string> alike;       ///< equivalent names of this form
  std::vector<std::string> besides;     ///< names of further effects in this form
  std::string form;                     ///< description of the form
  std::map<std::string, double> truth;  ///< parameters of the answer that this form corresponds to
  std::vector<std::string> variables;   ///< variables that the error depends on; any of them is
                                        ///< right
  std::vector<std::string> channels;    ///< channels that show it, without the machine's name
};

/// A form, with its correct answer.
struct Hidden {
  std::size_t axis = 0;
  AxisForm form;
  Concealed concealed;
};

/// Names of the effects that the tool is to name.
const std::vector<std::string>& NameableEffects();

/// Adds the named effect to a joint's form. CanHave must be true for `axis`.
Hidden Hide(const std::string& name, Strength strength, std::size_t axis, const AxisForm& onto,
            const Excavator& excavator, const AxisValues& start_rad, const Stream& stream);
bool CanHave(std::size_t axis, const std::string& name);
/// Whether both may be on one joint: they concern different parts of it.
bool GoTogether(const std::string& a, const std::string& b);

/// Adds an effect outside the tool's names.
Hidden HideOutside(std::size_t axis, std::size_t other_axis, const Stream& stream);

}  // namespace tera::blind
