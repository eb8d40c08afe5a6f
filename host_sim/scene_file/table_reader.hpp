/// Reads into a scene what its keys hold, as the list of keys tells.
#pragma once

#include <vector>

#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/table_cursor.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {

/// The values of one table, each checked by itself; those that the scene does not use are left alone.
/// @param scene  with all tables that are there, and the values of those before this one
/// @throws SceneError  a value that is missing, or is not what its key allows
void read_table(const TableCursor& cursor, scene::Scene& scene);

/// Nothing that a scene holds may be silently ignored.
/// @param table  the last one that has been read: other keys too may depend on it
/// @throws SceneError  the first key in the file of which the scene makes no use, unless the variant
///                     takes them all
void reject_unused(const Variant& variant, const KeyTable& table, const scene::Scene& scene);

// The tables whose keys are those of other tables.

/// @param so_far  with a value of each key that may vary
/// @throws SceneError  a key of which this scene has no value, or that has a true value besides; a
///         relative tolerance of the value 0, or one that leaves the range of its key
std::vector<scene::Tolerance> read_tolerances(const Variant& variant, const scene::Scene& so_far);

/// @throws SceneError  a key of which this scene has no value; a value outside the range of its key
std::vector<scene::TrueValue> read_true_values(const Variant& variant, const scene::Scene& so_far);

/// The same of a scene that is known to have a value of each.
std::vector<scene::TrueValue> given_true_values(const Variant& variant);

}  // namespace sonoglide::scene_file
