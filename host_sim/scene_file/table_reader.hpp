/// Reads into a scene what its keys hold, as the list of keys tells.
#pragma once

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

}  // namespace sonoglide::scene_file
