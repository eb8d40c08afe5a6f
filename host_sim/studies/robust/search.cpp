#include "host_sim/studies/robust/study.hpp"

#include <algorithm>
#include <limits>
#include <nlopt.hpp>

namespace sonoglide::robust {
namespace {

/// Counts the runs and keeps the highest place.
class Climb {
 public:
  explicit Climb(const Function& function) : function_(function) {}

  double operator()(const Place& place) {
    const double value = function_(runs_++, place);
    if (value > highest_) {
      highest_ = value;
      top_ = place;
    }
    return value;
  }

  std::size_t runs() const { return runs_; }
  const Place& top() const { return top_; }

 private:
  const Function& function_;
  std::size_t runs_ = 0;
  double highest_ = -std::numeric_limits<double>::infinity();
  Place top_;
};

double evaluate(const Place& place, Place& /*gradient*/, void* climb) {
  return (*static_cast<Climb*>(climb))(place);
}

/// Coordinates near a face of the cube moved onto it.
Place on_faces(Place place) {
  constexpr double near = 1e-3;
  for (double& coordinate : place) {
    coordinate = coordinate < near ? 0.0 : coordinate > 1.0 - near ? 1.0 : coordinate;
  }
  return place;
}

}  // namespace

void climb(const Place& start, std::size_t runs, const Function& function) {
  constexpr double first_step = 0.1;
  constexpr double last_step = 1e-4;
  Climb state(function);
  nlopt::opt optimiser(nlopt::LN_COBYLA, static_cast<unsigned>(start.size()));
  optimiser.set_lower_bounds(0.0);
  optimiser.set_upper_bounds(1.0);
  optimiser.set_max_objective(evaluate, &state);
  optimiser.set_initial_step(first_step);
  optimiser.set_xtol_abs(last_step);
  optimiser.set_maxeval(static_cast<int>(std::max<std::size_t>(runs - 1, 1)));
  Place place = start;
  double highest = 0.0;
  try {
    optimiser.optimize(place, highest);
  } catch (const nlopt::roundoff_limited&) {
    // As high as numbers go.
  }
  const Place corner = on_faces(state.top());
  if (corner != state.top() && state.runs() < runs) {
    state(corner);
  }
}

}  // namespace sonoglide::robust
