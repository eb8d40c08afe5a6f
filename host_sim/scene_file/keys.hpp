/// Every key of a scene, in one list: reader, echo, refusals, suggestions, reference and JSON Schema
/// are made from it.
#pragma once

#include <string_view>
#include <vector>

#include "host_sim/scene_file/key.hpp"

namespace sonoglide::scene_file {

/// Every table with its keys, in the order in which scenes are read and echoed.
const std::vector<KeyTable>& key_tables();

/// The table of this name; null if there is none.
const KeyTable* find_table(std::string_view name);
/// Its key of this name; null if there is none.
const Key* find_key(const KeyTable& table, std::string_view name);

/// @throws std::logic_error  no scene has such a table
const KeyTable& key_table(std::string_view name);

/// @throws std::logic_error  the table has no such key
const Key& key_of(const KeyTable& table, std::string_view name);

/// `kg`, `m/s`, `periods`; empty for words and for numbers without a unit. Of a profile, that of its
/// values.
std::string_view unit_of(const Key& key);

/// The keys of each table.
std::vector<Key> plant_keys();
std::vector<Key> friction_keys();
std::vector<Key> sliding_keys();
std::vector<Key> load_keys();
std::vector<Key> transducer_keys();
std::vector<Key> drive_keys();
std::vector<Key> solver_keys();
std::vector<Key> run_keys();
std::vector<Key> controller_keys();
std::vector<Key> sensor_keys();
std::vector<Key> model_error_keys();

}  // namespace sonoglide::scene_file
