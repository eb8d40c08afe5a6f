#include "host_sim/scene_file/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/solver_facts.hpp"
#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/configure/vibration/notch_design.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/sections.hpp"
#include "host_sim/scene_file/table_cursor.hpp"
#include "host_sim/scene_file/tolerances.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {
namespace {

/// The words of those for which `holds(method)`.
template <class Condition>
std::string methods_that(const Condition& holds) {
  std::string words;
  for (const scene::Named<scene::SolverMethod>& each : configure::solver_methods) {
    if (holds(each.value)) {
      words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", each.name);
    }
  }
  return words;
}

void require_solvable(const scene::Scene& scene, const Document& document) {
  const scene::SolverMethod method = scene.solver.method;
  if (configure::solves(method, scene.friction.law)) {
    return;
  }
  const std::string allowed = methods_that(
      [&](scene::SolverMethod each) { return configure::solves(each, scene.friction.law); });
  const char* key = "solver.method";
  throw SceneError(
      document.place_of(key), key,
      fmt::format("\"{}\" does not solve the friction law \"{}\"; allowed: {}",
                  configure::name_of(method), scene::name_of(scene.friction.law), allowed));
}

bool follows_straight_drives(scene::SolverMethod method) {
  return configure::with_solver(
      method, [](auto solver) { return !decltype(solver)::straight_orders.empty(); });
}

/// A drive of straight pieces is solved by fewer methods, and in one order.
void settle_waveform(scene::Scene& scene, const Document& document) {
  if (!scene.drive || scene.drive->waveform == scene::Waveform::cosine) {
    return;
  }
  const auto fail = [&](const char* key, std::string_view value, std::string_view allowed) {
    throw SceneError(document.place_of(key), key,
                     fmt::format("{} does not follow the waveform \"{}\"; allowed: {}", value,
                                 scene::name_of(scene::waveforms, scene.drive->waveform), allowed));
  };
  scene::Solver& solver = scene.solver;
  if (!follows_straight_drives(solver.method)) {
    fail("solver.method", configure::name_of(solver.method), methods_that(follows_straight_drives));
  }
  const std::optional<int> only = configure::with_solver(solver.method, [](auto described) {
    using Described = decltype(described);
    std::optional<int> order;
    if constexpr (Described::takes_order && !Described::straight_orders.empty()) {
      order = Described::straight_orders[0];
    }
    return order;
  });
  if (only && solver.order.value_or(*only) != *only) {
    fail("solver.order", std::to_string(*solver.order), std::to_string(*only));
  }
  solver.order = only;
}

/// How wide a robust notch is made.
void settle_shaping(scene::Controller& controller,
                    const std::vector<scene::Tolerance>& tolerances) {
  if (controller.shaping == scene::Shaping::robust && !controller.shaping_range) {
    controller.shaping_range = configure::default_shaping_range(tolerances);
  }
}

/// A vibration that is felt in the friction is known no better than the friction, which is therefore
/// learnt first.
void settle_calibration(scene::Scene& scene, const configure::ControlDesign& design,
                        const Variant& variant) {
  if (scene.vibration_mode() == scene::VibrationMode::sensorless &&
      !TableCursor(variant, "controller").has("calibration_s")) {
    scene.controller->calibration_s = configure::shortest_calibration_s(scene, design);
  }
}

/// A closed loop needs a controller that can be designed: told here, where a key has its place in
/// the file. The design is not kept with it, for whoever reads a scene may change it.
configure::ControlDesign required_controller(const scene::Scene& scene, const Document& document) {
  try {
    return configure::design_control(scene);
  } catch (const configure::ConfigurationError& error) {
    throw SceneError(document.place_of(error.key()), error.key(), error.what());
  }
}

/// All but what the truth is beside.
scene::Scene read_values(const Variant& variant) {
  const Document& document = variant.document();
  scene::Scene scene;
  scene.name = document.name();
  scene.plant = read_plant(variant);
  scene.friction = read_friction(variant, scene.plant);
  scene.sliding = read_sliding(variant, scene.friction);
  scene.transducer = read_transducer(variant);
  scene.drive = read_drive(variant, scene.transducer);
  scene.solver = read_solver(variant);
  require_solvable(scene, document);
  settle_waveform(scene, document);
  scene.run = read_run(variant, scene);
  scene.controller = read_controller(variant, scene);
  scene.sensor = read_sensor(variant, scene);
  scene.model_error = read_model_error(variant, scene);
  return scene;
}

bool has(const std::vector<scene::TrueValue>& values, std::string_view key) {
  return std::any_of(values.begin(), values.end(),
                     [key](const scene::TrueValue& each) { return each.key == key; });
}

/// What follows by default from a value that has a true one beside it follows from the stated one.
void keep_what_follows(scene::Scene& truth, const scene::Scene& nominal) {
  if (!has(truth.true_values, "friction.normal_force_N")) {
    truth.friction.normal_force_N = nominal.friction.normal_force_N;
  }
  truth.sensor.force_full_scale_N = nominal.sensor.force_full_scale_N;
  truth.run = nominal.run;
  if (truth.controller) {
    truth.controller->calibration_s = nominal.controller->calibration_s;
  }
}

}  // namespace

scene::Scene read(const Document& document, const std::vector<VariedValue>& values,
                  UnusedKeys* unused) {
  const Variant variant(document, values, unused);
  scene::Scene scene = read_values(variant);
  scene.tolerances = read_tolerances(variant, scene);
  if (scene.controller) {
    settle_shaping(*scene.controller, scene.tolerances);
    settle_calibration(scene, required_controller(scene, document), variant);
  }
  if (read_true_values(variant, scene).empty()) {
    return scene;
  }
  return read_truth(document, values, std::make_shared<const scene::Scene>(std::move(scene)));
}

scene::Scene read_truth(const Document& document, const std::vector<VariedValue>& values,
                        std::shared_ptr<const scene::Scene> nominal) {
  UnusedKeys unused_too;
  const Variant variant(document, values, &unused_too, Values::truth);
  scene::Scene scene = read_values(variant);
  scene.true_values = given_true_values(variant);
  scene.tolerances = nominal->tolerances;
  keep_what_follows(scene, *nominal);
  scene.nominal_scene = std::move(nominal);
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
