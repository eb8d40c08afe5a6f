/// One run of one solver over one scene, what it shows of the solver, and the solvers that are tried.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::stability {

struct TrialPlan {
  int periods;               ///< carrier periods, of the plant's own clock where there is no drive
  double setting;            ///< tolerance of an adaptive solver, else steps per period
  std::uint32_t step_limit;  ///< per period
};

struct TrialResult {
  bool supported = true;          ///< false: the solver does not take this friction law
  bool finite = true;             ///< all that the solver handed over as good
  double largest_friction = 0.0;  ///< max |F|/Fc over the ends of its steps
  double friction_ratio = 0.0;    ///< mean(F)/Fc over all periods, positive along the sliding
  double balance_residual = 0.0;  ///< see Witness
  plant::Error error = plant::Error::none;  ///< what the solver itself said
};

/// Stops at the first error that the solver reports; what it did before counts.
using Trial = TrialResult (*)(const scene::Scene& scene, const TrialPlan& plan);

/// declined_*: the solver itself reported an error. silent_*: it handed the state over as good.
enum class Verdict {
  good,
  wrong,  ///< finite and bounded, but off: the one that nothing in the result gives away
  silent_friction_bound,
  silent_not_finite,
  declined_friction_bound,
  declined_step_too_long,
  declined_not_finite,
  declined_too_many_steps,
  unsupported,  ///< the solver does not take this friction law
};

inline constexpr std::size_t verdict_count = 9;

/// @param error         how far off the result is; NaN is too far
/// @param allowed_error the most that is good
/// @param bound         the largest |F|/Fc that is none of the solver's fault
Verdict judge(const TrialResult& result, double error, double allowed_error, double bound);

/// For files: the names in order, good and wrong as each kind of experiment calls them.
std::array<std::string_view, verdict_count> verdict_names(std::string_view good,
                                                          std::string_view wrong);

// The solvers whose limits are drawn.

/// A solver in one arithmetic.
struct TriedPrecision {
  std::string_view name;
  Trial trial;
  double extreme_setting;  ///< tolerance or steps per period, for the random scenes
  double friction_bound;   ///< largest |F|/Fc that the solver lets pass
};

struct TriedSolver {
  std::string name;
  bool adaptive;  ///< set by a tolerance, else by a number of steps per period
  std::array<TriedPrecision, 2> precisions;  ///< float64, float32
};

const std::vector<TriedSolver>& solvers();

// What a solver's steps show: how far |phi| goes, and whether the energy adds up.

/// An account that sums in binary64, so that it measures the solver and not itself.
class Witness {
 public:
  template <class Step>
  void add(const Step& step) {
    const auto end = step.at(step.length());
    // Not std::max: it would pass over a NaN.
    const double friction = std::abs(static_cast<double>(end.friction));
    largest_friction_ = friction <= largest_friction_ ? largest_friction_ : friction;
    friction_integral_ += static_cast<double>(step.friction_integral());
    const auto motion = step.motion_integrals();
    drive_.add(static_cast<double>(motion.drive_work));
    damping_.add(static_cast<double>(motion.damping_work));
    contact_.add(static_cast<double>(step.friction_work()));
    pull_.add(static_cast<double>(step.sliding_work()));
    const double length = static_cast<double>(step.length());
    raise(highest_velocity_square_, end.velocity, motion.velocity_square, length);
    raise(highest_displacement_square_, end.displacement, motion.displacement_square, length);
  }

  double largest_friction() const { return largest_friction_; }
  double friction_integral() const { return friction_integral_; }

  /// Residual of
  ///   stored(after) - stored(before) = drive - damping - sigma beta (friction - sliding work)
  /// relative to the largest energy that passed: the sum over all steps of the magnitude of one of
  /// the works, or the largest energy stored. The net works would not do: where they cancel over a
  /// period, the rounding of what came and went would look like a fault. Nor would the ends of the
  /// steps alone: a step of a whole period hides between them all that was stored, but not its
  /// mean.
  template <class Model, class Scalar>
  double balance_residual(const Model& model, const plant::State<Scalar>& before,
                          const plant::State<Scalar>& after) const {
    const auto stiffness = static_cast<double>(model.stiffness);
    const auto contact = static_cast<double>(model.contact_work(Scalar(1)));
    const double gain = stored(stiffness, after) - stored(stiffness, before);
    const double given = drive_.net - damping_.net - contact * (contact_.net - pull_.net);
    const double passed =
        std::max({drive_.gross, damping_.gross, std::abs(contact) * contact_.gross,
                  std::abs(contact) * pull_.gross, stored(stiffness, before),
                  0.5 * highest_velocity_square_, 0.5 * stiffness * highest_displacement_square_});
    // What comes near the smallest number of the arithmetic cannot be added up in it.
    constexpr double least = static_cast<double>(std::numeric_limits<Scalar>::min()) /
                             static_cast<double>(std::numeric_limits<Scalar>::epsilon());
    return std::abs(gain - given) / std::max(passed, least);
  }

 private:
  struct Work {
    double net = 0.0;
    double gross = 0.0;

    void add(double work) {
      net += work;
      gross += std::abs(work);
    }
  };

  /// A square cannot stay below its mean over a step.
  template <class Scalar>
  static void raise(double& highest, Scalar end, Scalar integral, double length) {
    const auto value = static_cast<double>(end);
    const double mean = length > 0.0 ? static_cast<double>(integral) / length : 0.0;
    highest = std::max({highest, value * value, mean});
  }

  template <class Scalar>
  static double stored(double stiffness, const plant::State<Scalar>& state) {
    const auto velocity = static_cast<double>(state.velocity);
    const auto displacement = static_cast<double>(state.displacement);
    return 0.5 * (velocity * velocity + stiffness * displacement * displacement);
  }

  double largest_friction_ = 0.0;
  double friction_integral_ = 0.0;
  double highest_velocity_square_ = 0.0;
  double highest_displacement_square_ = 0.0;
  Work drive_;
  Work damping_;
  Work contact_;
  Work pull_;
};

}  // namespace sonoglide::stability
