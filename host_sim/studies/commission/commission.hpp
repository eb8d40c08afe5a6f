/// The plant of a running unit: recorded over its serial line, and identified.
#pragma once

#include <functional>
#include <string>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/studies/identify/plant/study.hpp"

namespace sonoglide::commission {

/// @param device      serial device of the unit, which is driven and at the end stopped
/// @param experiment  identifiable; the one that the unit's image was built from
/// @param progress    is told the part done
/// @throws process::ProcessError   there is no unit of the scene, or as unit::record_plant()
/// @throws loop::ComputationError  as identify::plant::study()
identify::plant::PlantStudy study(const std::string& device,
                                  const configure::Experiment& experiment,
                                  const std::function<void(double)>& progress);

}  // namespace sonoglide::commission
