#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "host_sim/report/run_parts.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene_file/echo.hpp"

namespace sonoglide::report {
namespace {

std::string lead(const scene::Scene& scene, const loop::RunResult& result) {
  std::string text =
      scene.controller
          ? fmt::format("Closed loop, controller in {}",
                        scene::name_of(scene::arithmetics, scene.controller->arithmetic))
          : std::string("Open loop");
  text += fmt::format(". Friction law: {}. Solver: {}. {} simulated in {}.",
                      scene::name_of(scene.friction.law), scene::name_of(scene.solver.method),
                      output::quantity(result.final_time_s, "s", 6),
                      output::quantity(result.wall_s, "s", 3));
  return text;
}

output::Section figures_section(const scene::Scene& scene, const loop::RunResult& result,
                                const RunFindings& findings) {
  output::Section section{"Figures", "", {}, {run_table(scene, result, findings)}};
  if (result.electrical) {
    section.tables.push_back(electrical_table(*result.electrical));
  }
  if (result.control && !result.control->signals.empty()) {
    section.tables.push_back(signal_table(*result.control));
  }
  if (result.image) {
    section.tables.push_back(image_table(*result.image));
  }
  return section;
}

}  // namespace

output::Page run_page(const configure::Experiment& experiment, const loop::RunResult& result,
                      const RunFindings& findings) {
  const scene::Scene& scene = experiment.plant;
  output::Page page{scene.name, lead(scene, result), run_warnings(scene, result, findings), {}, {}};
  page.scene = scene_file::to_json(experiment.nominal);
  page.notes = run_remarks(scene, result, findings);
  if (page.scene.contains(nlohmann::ordered_json::json_pointer("/sensor/seed"))) {
    page.seed = scene.sensor.seed;
  }
  if (const TextureMeter* texture = findings.texture()) {
    page.tables.push_back(texture_table(scene, *texture));
  } else if (scene.controller) {
    page.tables.push_back(step_table(scene, findings));
  }
  if (result.control && result.control->friction) {
    page.tables.push_back(learnt_friction_table(*result.control->friction));
  }
  if (scene.sensor.vibration && findings.texture() == nullptr) {
    page.tables.push_back(vibration_table(findings));
  }
  if (const TextureMeter* texture = findings.texture()) {
    page.sections.push_back(texture_section(scene, *texture));
  }
  // One carrier period is no course: its ratio stands in the figures, its motion in the sections below.
  if (const Course::Curve& course = findings.course().curve(); course.x().size() > 1) {
    page.sections.push_back(course_section(scene, course));
  }
  if (const VibrationCourse* vibration = findings.vibration()) {
    page.sections.push_back(vibration_section(scene, *vibration));
  }
  for (std::size_t i = 0; i < findings.close_ups().size(); ++i) {
    page.sections.push_back(close_up_section(scene, findings.close_ups()[i], i));
  }
  page.sections.push_back(ending_section(scene, findings.ending()));
  page.sections.push_back(figures_section(scene, result, findings));
  return page;
}

}  // namespace sonoglide::report
