/// Where steady sliding excites itself, over belt speed and drive, and the drives that quench it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "host_sim/loop/steady/self_excitation.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::self_excited {

struct Task {
  scene::Scene scene;
  double sliding_m_per_s;  ///< the scene's own
  double most_N;           ///< strongest drive on the map
};

/// The map goes to the drive's limit; of an open loop to four times its amplitude.
///
/// @throws configure::ConfigurationError  what has no steady sliding of one speed: a profile, no
///         sliding, no contact, no drive, another waveform than the cosine, the sign convention as
///         printed
Task make_task(const scene::Scene& scene);

using Progress = std::function<void(double fraction)>;

struct Study {
  Task task;
  bool falls;                              ///< the friction, with the velocity
  std::vector<double> speeds_m_per_s;      ///< by equal factors, a tenth to ten times the scene's
  std::vector<double> forces_N;            ///< by equal steps, from 0
  std::vector<steady::SteadySliding> map;  ///< a row of forces for each speed
  std::vector<steady::SteadySliding> at_own_speed;
  std::vector<steady::DriveWindow> windows;           ///< at the scene's speed
  std::vector<steady::DriveWindow> averaged_windows;  ///< likewise

  const steady::SteadySliding& at(std::size_t speed, std::size_t force) const {
    return map[speed * forces_N.size() + force];
  }
};

/// On every core.
Study study(const Task& task, const Progress& progress);

/// report.html, self_excited.csv, self_excited.json and self_excited.svg.
/// @throws process::ProcessError
output::StudyReport report(const Study& study);

}  // namespace sonoglide::self_excited
