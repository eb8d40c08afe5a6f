/// The tables whose keys are those of other tables.
#pragma once

#include <vector>

#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {

/// @param so_far  with a value of each key that may vary
/// @throws SceneError  a key of which this scene has no value, or that has a true value besides; a
///         relative tolerance of the value 0, or one that leaves the range of its key
std::vector<scene::Tolerance> read_tolerances(const Variant& variant, const scene::Scene& so_far);

/// @throws SceneError  a key of which this scene has no value; a value outside the range of its key
std::vector<scene::TrueValue> read_true_values(const Variant& variant, const scene::Scene& so_far);

/// The same of a scene that is known to have a value of each.
std::vector<scene::TrueValue> given_true_values(const Variant& variant);

}  // namespace sonoglide::scene_file
