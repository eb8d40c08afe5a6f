#include "host_sim/stability/solver_list.hpp"

#include <type_traits>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/adaptive_strang.hpp"
#include "firmware/plant/event_gauss.hpp"
#include "firmware/plant/event_taylor.hpp"
#include "firmware/plant/rk4.hpp"
#include "firmware/plant/rk4_event.hpp"
#include "firmware/plant/state_check.hpp"
#include "host_sim/scene/plant_scales.hpp"
#include "host_sim/stability/composition.hpp"
#include "host_sim/stability/run_trial.hpp"

namespace sonoglide::stability {
namespace {

/// For the random scenes, in float64 and in float32.
struct Settings {
  double float64;
  double float32;
};

/// The program's default tolerance, and one that float32 can hold.
constexpr Settings usual_tolerance = {1e-10, 1e-6};
/// Over random_scene_periods the balance of AdaptiveStrang then keeps below what is allowed.
constexpr Settings strang_tolerance = {1.6e-7, 1e-3};
constexpr Settings usual_steps = {200.0, 200.0};

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
Solver solver(std::string_view name, const Settings& extreme, Bound bound) {
  return {
      name,
      Knob == Control::tolerance,
      {{{"float64", trial<Method, double, Knob>, extreme.float64, friction_bound<double>(bound)},
        {"float32", trial<Method, float, Knob>, extreme.float32, friction_bound<float>(bound)}}}};
}

}  // namespace

const std::vector<Solver>& solvers() {
  static const std::vector<Solver> list = {
      solver<EventTaylor8, Control::tolerance>("event_taylor_8", usual_tolerance, Bound::exact),
      solver<EventTaylor12, Control::tolerance>("event_taylor_12", usual_tolerance, Bound::exact),
      solver<EventTaylor16, Control::tolerance>("event_taylor_16", usual_tolerance, Bound::exact),
      solver<EventGauss, Control::tolerance>("event_gauss", usual_tolerance, Bound::exact),
      solver<plant::AdaptiveStrang, Control::tolerance>("strang", strang_tolerance, Bound::exact),
      solver<plant::Rk4, Control::step>("rk4", usual_steps, Bound::rounded),
      solver<plant::Rk4Event, Control::step>("rk4_event", usual_steps, Bound::rounded),
  };
  return list;
}

}  // namespace sonoglide::stability
