/// What becomes of a random loop.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/report/step_metrics.hpp"
#include "tests/random_loops/loops/random_loop.hpp"

namespace sonoglide::random_loops {

/// How a target step ends. "Settled" is inside the band for good; "named" is a limit in the step's
/// steady part, or a fault up to its end.
enum class Verdict { prompt, late, never_named, never_unnamed };
inline constexpr std::size_t verdicts = 4;
inline constexpr std::array<std::string_view, verdicts> verdict_names = {
    "prompt", "late", "never_named", "never_unnamed"};

/// A prompt step settles within this.
inline constexpr double prompt_s = 1e-3;

struct StepOutcome {
  report::StepMetrics metrics;
  std::string fault;  ///< that the controller is in at the step's end; empty: none
  Verdict verdict = Verdict::never_unnamed;
  Verdict velocity_verdict = Verdict::never_unnamed;  ///< of the vibration, where it is damped
  bool at_end = false;  ///< settled, but only in the last quarter: a swing may have ended inside
  bool no_vibration = false;  ///< never settled, and none with a closed contact would do

  bool named() const;
  bool settled() const { return metrics.settling_time_s.has_value(); }
};

struct Outcome {
  RandomLoop loop;
  std::string refused;  ///< by the scene's reader or the design: key, and why; empty: run
  std::string refused_key;
  std::string failed;  ///< the computation, and why; empty: none
  std::vector<StepOutcome> steps;
};

/// Draws a loop, reads its scene and runs it. @param overrides  KEY=VALUE in its scene
Outcome outcome(std::uint32_t seed, std::uint32_t index, Vibration vibration,
                const std::vector<std::string>& overrides = {});

/// Of the loops 0 to count - 1, in their order, computed on all cores.
std::vector<Outcome> outcomes(std::uint32_t seed, std::uint32_t count,
                              Vibration vibration = Vibration::unseen,
                              const std::vector<std::string>& overrides = {});

}  // namespace sonoglide::random_loops
