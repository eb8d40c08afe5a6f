#include "host_sim/stability/solver_list.hpp"

#include <type_traits>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/event_gauss.hpp"
#include "firmware/plant/event_taylor.hpp"
#include "firmware/plant/rk4.hpp"
#include "firmware/plant/rk4_event.hpp"
#include "firmware/plant/state_check.hpp"
#include "firmware/plant/strang.hpp"
#include "host_sim/scene/plant_scales.hpp"
#include "host_sim/stability/composition.hpp"
#include "host_sim/stability/run_trial.hpp"

namespace sonoglide::stability {
namespace {

/// The program's default tolerance, and one that float32 can hold.
constexpr double tolerance_float64 = 1e-10;
constexpr double tolerance_float32 = 1e-6;
constexpr double steps_per_period = 200.0;

template <class Model>
using EventTaylor8 = plant::EventTaylor<Model, 8>;
template <class Model>
using EventTaylor12 = plant::EventTaylor<Model, 12>;
template <class Model>
using EventTaylor16 = plant::EventTaylor<Model, 16>;

/// With the nodes that suit the tolerances above.
template <class Model>
using EventGauss = plant::EventGauss<Model, std::is_same_v<typename Model::Scalar, float> ? 8 : 12>;

enum class Control { tolerance, step };
enum class Bound { exact, rounded };

/// Asked of the solver of a plant without friction: that of a law it refuses does not exist.
template <template <class> class Method, class Model>
constexpr bool takes = Method<
    plant::Model<friction::None<typename Model::Scalar>, plant::Undamped<typename Model::Scalar>,
                 plant::NoDrive>>::template solves<typename Model::FrictionLaw>;

template <template <class> class Method, class Scalar, Control Knob>
TrialResult trial(const scene::Scene& scene, const TrialPlan& plan) {
  const scene::PlantScales scales = scene::plant_scales(scene);
  const double setting = Knob == Control::tolerance ? plan.setting : numeric::two_pi / plan.setting;
  return with_model<Scalar>(scene, scales, [&](const auto& model) {
    using Model = std::decay_t<decltype(model)>;
    if constexpr (takes<Method, Model>) {
      return run_trial<Method<Model>>(scene, scales, model, plan, setting);
    } else {
      TrialResult refused;
      refused.supported = false;
      return refused;
    }
  });
}

/// rounded: as far past 1 as Rk4 calls rounding.
template <class Scalar>
constexpr double friction_bound(Bound bound) {
  return bound == Bound::exact ? 1.0 : static_cast<double>(plant::largest_friction<Scalar>);
}

template <template <class> class Method, Control Knob>
Solver solver(std::string_view name, Bound bound) {
  constexpr bool adaptive = Knob == Control::tolerance;
  return {name,
          adaptive,
          {{{"float64", trial<Method, double, Knob>,
             adaptive ? tolerance_float64 : steps_per_period, friction_bound<double>(bound)},
            {"float32", trial<Method, float, Knob>, adaptive ? tolerance_float32 : steps_per_period,
             friction_bound<float>(bound)}}}};
}

}  // namespace

const std::vector<Solver>& solvers() {
  static const std::vector<Solver> list = {
      solver<EventTaylor8, Control::tolerance>("event_taylor_8", Bound::exact),
      solver<EventTaylor12, Control::tolerance>("event_taylor_12", Bound::exact),
      solver<EventTaylor16, Control::tolerance>("event_taylor_16", Bound::exact),
      solver<EventGauss, Control::tolerance>("event_gauss", Bound::exact),
      solver<plant::Strang, Control::step>("strang", Bound::exact),
      solver<plant::Rk4, Control::step>("rk4", Bound::rounded),
      solver<plant::Rk4Event, Control::step>("rk4_event", Bound::rounded),
  };
  return list;
}

}  // namespace sonoglide::stability
