/// The parts of a run's page.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "host_sim/loop/run.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/report/run_findings.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// What the reader has to know before the figures: first of each target step that never settles.
std::vector<std::string> run_warnings(const scene::Scene& scene, const loop::RunResult& result,
                                      const RunFindings& findings);
/// What is good to know of the loop: nothing is wrong.
std::vector<std::string> run_remarks(const scene::Scene& scene, const loop::RunResult& result,
                                     const RunFindings& findings);

/// Of a load that is faster than any velocity of a scene may be.
std::vector<std::string> load_notes(const scene::Scene& scene, const RunFindings& findings);
/// Why there is no friction ratio where a load that no drive shakes has stayed within the elastic length of
/// its contact, Fc/Kt, so that nothing slides; absent in any other run.
std::optional<std::string> stick_text(const scene::Scene& scene, const RunFindings& findings);

/// Where the controller has learnt its friction force from one that was not steady.
std::vector<std::string> calibration_notes(const RunFindings& findings);

// Of a texture, in place of steps.

/// An entry for each harmonic.
nlohmann::ordered_json texture_json(const TextureMeter& meter, const TargetUnit& unit);
std::string texture_lines(const scene::Scene& scene, const TextureMeter& meter);
output::Table texture_table(const scene::Scene& scene, const TextureMeter& meter);
/// What is held, over the sliding distance.
output::Section texture_section(const scene::Scene& scene, const TextureMeter& meter);
/// Where the mean or the first harmonic is off.
std::vector<std::string> texture_warnings(const scene::Scene& scene, const TextureMeter& meter);

output::Table step_table(const scene::Scene& scene, const RunFindings& findings);
/// What a controller has learnt of its contact while driving.
output::Table learnt_friction_table(const loop::FrictionBelief& belief);
output::Table vibration_table(const RunFindings& findings);
output::Table run_table(const scene::Scene& scene, const loop::RunResult& result,
                        const RunFindings& findings);
output::Table electrical_table(const loop::ElectricalBalance& balance);
output::Table signal_table(const loop::ControlRecord& control);

/// Of what is wanted, and of limits: letters' colour and dashes, beside what is reached.
inline const output::Pen target_pen{"#000000", 2.0, 2};

/// Over the time of the whole run, which all such charts show together.
output::Chart course_chart(const char* title, const char* note, const std::string& label,
                           const std::vector<double>& time, std::vector<output::Curve> curves);
/// A line at a value.
output::Curve level(const char* label, const std::vector<double>& x, double value);
output::Section course_section(const scene::Scene& scene, const Course::Curve& curve);
output::Section vibration_section(const scene::Scene& scene, const VibrationCourse& course);

/// @param index  of the target step; in open loop 0, the beginning
output::Section close_up_section(const scene::Scene& scene, const loop::Recording& recording,
                                 std::size_t index);
/// The cycle of the contact and the spectrum.
output::Section ending_section(const scene::Scene& scene, const loop::Recording& recording);

}  // namespace sonoglide::report
