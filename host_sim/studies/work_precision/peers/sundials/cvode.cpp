#include "host_sim/studies/work_precision/peers/contender.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <type_traits>

namespace sonoglide::peers {
namespace {

/// y, y', phi and the integral of phi.
constexpr sunindextype state_size = 4;
constexpr long most_steps_per_call = 10000000;

/// What the callbacks see.
struct Motion {
  Problem problem;
  double direction;  ///< sgn V, frozen between two roots

  double sliding(N_Vector x) const {
    return problem.sliding_velocity + problem.vibration_sign * NV_Ith_S(x, 1);
  }
};

int right_hand_side(realtype tau, N_Vector x, N_Vector slope, void* user) {
  const Motion& motion = *static_cast<const Motion*>(user);
  const Problem& problem = motion.problem;
  const double velocity = NV_Ith_S(x, 1);
  const double friction = NV_Ith_S(x, 2);
  NV_Ith_S(slope, 0) = velocity;
  NV_Ith_S(slope, 1) = problem.drive_amplitude * std::cos(tau) - problem.damping * velocity -
                       problem.stiffness * NV_Ith_S(x, 0) - problem.friction_force * friction;
  NV_Ith_S(slope, 2) =
      problem.contact_stiffness * motion.sliding(x) * (1.0 - motion.direction * friction);
  NV_Ith_S(slope, 3) = friction;
  return 0;
}

int jacobian(realtype /*tau*/, N_Vector x, N_Vector /*slope*/, SUNMatrix matrix, void* user,
             N_Vector /*scratch1*/, N_Vector /*scratch2*/, N_Vector /*scratch3*/) {
  const Motion& motion = *static_cast<const Motion*>(user);
  const Problem& problem = motion.problem;
  SUNMatZero(matrix);
  SM_ELEMENT_D(matrix, 0, 1) = 1.0;
  SM_ELEMENT_D(matrix, 1, 0) = -problem.stiffness;
  SM_ELEMENT_D(matrix, 1, 1) = -problem.damping;
  SM_ELEMENT_D(matrix, 1, 2) = -problem.friction_force;
  SM_ELEMENT_D(matrix, 2, 1) = problem.contact_stiffness * problem.vibration_sign *
                               (1.0 - motion.direction * NV_Ith_S(x, 2));
  SM_ELEMENT_D(matrix, 2, 2) = -problem.contact_stiffness * motion.sliding(x) * motion.direction;
  SM_ELEMENT_D(matrix, 3, 2) = 1.0;
  return 0;
}

int reversal(realtype /*tau*/, N_Vector x, realtype* value, void* user) {
  value[0] = static_cast<const Motion*>(user)->sliding(x);
  return 0;
}

/// Frees a handle as the library has it.
template <auto Free>
struct Freed {
  template <class Handle>
  void operator()(Handle handle) const {
    Free(handle);
  }
};
struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeMemory {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

template <class Handle, class Free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

SUNContext make_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) {
    throw std::bad_alloc();
  }
  return context;
}

/// CVODE reports success as 0 and every failure of a set-up call as a negative number; with valid
/// arguments that can only be memory.
void require(int flag) {
  if (flag < 0) {
    throw std::bad_alloc();
  }
}

enum class Iteration { newton, fixed_point };

class Cvode final : public Contender {
 public:
  Cvode(const Problem& problem, int method, Iteration iteration, double tolerance)
      : motion_{problem, 1.0},
        context_(make_context()),
        state_(N_VNew_Serial(state_size, context_.get())),
        matrix_(SUNDenseMatrix(state_size, state_size, context_.get())),
        linear_solver_(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get())),
        fixed_point_(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get())),
        memory_(CVodeCreate(method, context_.get())) {
    set_initial_state();
    void* memory = memory_.get();
    require(CVodeInit(memory, right_hand_side, 0.0, state_.get()));
    require(CVodeSetErrFile(memory, nullptr));
    require(CVodeSStolerances(memory, tolerance, tolerance));
    require(CVodeSetUserData(memory, &motion_));
    if (iteration == Iteration::newton) {
      require(CVodeSetLinearSolver(memory, linear_solver_.get(), matrix_.get()));
      require(CVodeSetJacFn(memory, jacobian));
    } else {
      require(CVodeSetNonlinearSolver(memory, fixed_point_.get()));
    }
    require(CVodeRootInit(memory, 1, reversal));
    require(CVodeSetMaxNumSteps(memory, most_steps_per_call));
  }

  void restart() override {
    set_initial_state();
    tau_ = 0.0;
    target_ = 0.0;
    steps_ = 0;
    start_afresh();
  }

  std::string advance(int periods) override {
    const double end = motion_.problem.periods * carrier_period;
    target_ = std::min(target_ + periods * carrier_period, end);
    while (tau_ < target_ && !ended_) {
      const int flag = CVode(memory_.get(), end, state_.get(), &tau_, CV_ONE_STEP);
      if (flag < 0) {
        return flag == CV_TOO_MUCH_ACC ? "tolerance below rounding" : "step failed";
      }
      ended_ = flag == CV_TSTOP_RETURN;
      if (flag == CV_ROOT_RETURN) {
        reverse();
      }
    }
    return {};
  }

  double friction_integral() const override { return NV_Ith_S(state_.get(), 3); }
  std::uint64_t steps() const override { return steps_ + steps_since_start(); }

 private:
  void set_initial_state() {
    const Problem& problem = motion_.problem;
    N_Vector x = state_.get();
    NV_Ith_S(x, 0) = problem.displacement;
    NV_Ith_S(x, 1) = problem.velocity;
    NV_Ith_S(x, 2) = problem.friction;
    NV_Ith_S(x, 3) = 0.0;
    motion_.direction = motion_.sliding(x) < 0.0 ? -1.0 : 1.0;
  }

  void reverse() {
    int crossing = 0;
    require(CVodeGetRootInfo(memory_.get(), &crossing));
    motion_.direction = crossing;
    steps_ += steps_since_start();
    start_afresh();
  }

  void start_afresh() {
    ended_ = false;
    require(CVodeReInit(memory_.get(), tau_, state_.get()));
    require(CVodeSetStopTime(memory_.get(), motion_.problem.periods * carrier_period));
  }

  std::uint64_t steps_since_start() const {
    long count = 0;
    require(CVodeGetNumSteps(memory_.get(), &count));
    return static_cast<std::uint64_t>(count);
  }

  Motion motion_;
  Owned<SUNContext, FreeContext> context_;
  Owned<N_Vector, Freed<N_VDestroy>> state_;
  Owned<SUNMatrix, Freed<SUNMatDestroy>> matrix_;
  Owned<SUNLinearSolver, Freed<SUNLinSolFree>> linear_solver_;
  Owned<SUNNonlinearSolver, Freed<SUNNonlinSolFree>> fixed_point_;
  std::unique_ptr<void, FreeMemory> memory_;
  realtype tau_ = 0.0;
  double target_ = 0.0;
  bool ended_ = false;
  std::uint64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Contender> cvode_adams(const Problem& problem, double tolerance) {
  return std::make_unique<Cvode>(problem, CV_ADAMS, Iteration::newton, tolerance);
}

std::unique_ptr<Contender> cvode_adams_fixed_point(const Problem& problem, double tolerance) {
  return std::make_unique<Cvode>(problem, CV_ADAMS, Iteration::fixed_point, tolerance);
}

std::unique_ptr<Contender> cvode_bdf(const Problem& problem, double tolerance) {
  return std::make_unique<Cvode>(problem, CV_BDF, Iteration::newton, tolerance);
}

}  // namespace sonoglide::peers
