/// What the values of a table owe to each other and to those of the tables before it.
#pragma once

#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/table_cursor.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {

/// @param scene  with all tables that are there
/// @throws SceneError  the table is missing, or of no use
void check_presence(const TableCursor& cursor, const scene::Scene& scene);

/// Fills in what follows from the values of a table that has been read.
/// @throws SceneError  a value that does not suit the others
void check_table(const TableCursor& cursor, const Variant& variant, scene::Scene& scene);

/// Picks the method of a scene that names none, by all of its tables.
void settle_method(const TableCursor& cursor, scene::Scene& scene);

void check_solver(const TableCursor& cursor, const Variant& variant, scene::Scene& scene);
void check_run(const TableCursor& cursor, const Variant& variant, scene::Scene& scene);
void check_controller(const TableCursor& cursor, const Variant& variant, scene::Scene& scene);
void check_sensor(const TableCursor& cursor, const Variant& variant, scene::Scene& scene);

}  // namespace sonoglide::scene_file
