/// Identification of a transducer's circuit from a sweep.
#pragma once

#include <string>

#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/figures.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

struct ImpedanceStudy {
  std::string name;  ///< of the file
  Sweep sweep;       ///< what was fitted
  CircuitFit fit;
  MechanicalFact fact;
  Identification identification;
  std::string scene;  ///< the text of scene.toml; empty where there is none
};

/// @param name  of the file, for the titles
/// @throws loop::ComputationError  see select_circuit
ImpedanceStudy study(const std::string& name, const Sweep& sweep, const MechanicalFact& fact);

}  // namespace sonoglide::identify::impedance
