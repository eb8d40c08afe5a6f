#include "host_sim/scene_file/reader.hpp"

#include <algorithm>

#include "host_sim/scene_file/checks.hpp"
#include "host_sim/scene_file/table_cursor.hpp"
#include "host_sim/scene_file/table_reader.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {
namespace {

/// All but what is of other values.
scene::Scene read_values(const Variant& variant) {
  scene::Scene scene;
  scene.name = variant.document().name();
  // The tables that are there tell which keys a scene uses, those of tables before them too.
  for (const KeyTable& table : key_tables()) {
    if (table.add != nullptr && variant.find(table.name) != nullptr) {
      table.add(scene);
    }
  }
  for (const KeyTable& table : key_tables()) {
    const TableCursor cursor(variant, table);
    if (table.of_others) {
      break;
    }
    check_presence(cursor, scene);
    if (table.has == nullptr || table.has(scene)) {
      read_table(cursor, scene);
      check_table(cursor, variant, scene);
      reject_unused(variant, table, scene);
    }
  }
  settle_method(TableCursor(variant, "solver"), scene);
  return scene;
}

bool has(const std::vector<scene::TrueValue>& values, std::string_view key) {
  return std::any_of(values.begin(), values.end(),
                     [key](const scene::TrueValue& each) { return each.key == key; });
}

/// What follows by default from a value that has a true one beside it follows from the stated one.
void keep_what_follows(scene::Scene& truth, const scene::Scene& stated) {
  if (!has(truth.true_values, "friction.normal_force_N")) {
    truth.friction.normal_force_N = stated.friction.normal_force_N;
  }
  truth.sensor.force_full_scale_N = stated.sensor.force_full_scale_N;
  truth.solver = stated.solver;
  truth.run = stated.run;
  truth.controller = stated.controller;
}

}  // namespace

scene::Scene read(const Document& document, const std::vector<VariedValue>& values,
                  UnusedKeys* unused) {
  const Variant variant(document, values, unused);
  scene::Scene scene = read_values(variant);
  scene.tolerances = read_tolerances(variant, scene);
  scene.true_values = read_true_values(variant, scene);
  return scene;
}

scene::Scene read_truth(const Document& document, const std::vector<VariedValue>& values,
                        const scene::Scene& stated) {
  UnusedKeys unused_too;
  const Variant variant(document, values, &unused_too, Values::truth);
  scene::Scene scene = read_values(variant);
  scene.true_values = given_true_values(variant);
  scene.tolerances = stated.tolerances;
  keep_what_follows(scene, stated);
  return scene;
}

scene::Scene read_text(std::string_view text, const std::string& file,
                       const std::vector<std::string>& overrides) {
  return read(Source{file, std::string(text)}, overrides);
}

scene::Scene read(const Source& source, const std::vector<std::string>& overrides) {
  return read(Document(source, overrides));
}

scene::Scene read_file(const std::filesystem::path& path,
                       const std::vector<std::string>& overrides) {
  return read(read_source(path), overrides);
}

}  // namespace sonoglide::scene_file
