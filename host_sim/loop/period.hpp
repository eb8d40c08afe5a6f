/// The course of a run, carrier period by carrier period.
#pragma once

#include "firmware/control/drive_command.hpp"

namespace sonoglide::loop {

/// One carrier period (where there is no drive: one thousandth of the run).
struct Period {
  double begin_s;
  double end_s;
  double friction_ratio;          ///< ρ, see PowerRatios; NaN without friction
  double begin_velocity_m_per_s;  ///< sliding
  double end_velocity_m_per_s;
  double drive_amplitude_N;    ///< in force during it
  double target;               ///< that its drive was picked for; NaN in open loop
  control::State state;        ///< of the command in force during it
  control::Limit limit;        ///< likewise
  control::Settling settling;  ///< likewise
  double commanded_ratio;      ///< likewise: friction ratio, target and feedback together
};

/// Takes the carrier periods of a run, in order, as soon as each is over.
class PeriodSink {
 public:
  virtual ~PeriodSink() = default;
  virtual void take(const Period& period) = 0;
};

}  // namespace sonoglide::loop
