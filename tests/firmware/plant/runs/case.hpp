/// A plant in words: Case().contact_stiffness(1.2).friction_force(0.3).stiffness(0.4).
#pragma once

#include <type_traits>

#include "firmware/friction/dahl.hpp"
#include "firmware/friction/none.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"

namespace sonoglide::plant {

/// Numbers in double, rounded to a model's scalar where they enter it; a model takes those that it
/// has. What is not said is 0, the vibration dissipates, and a load
/// has the mass of the oscillator.
class Case {
 public:
  constexpr Case contact_stiffness(double kappa) const { return with(&Case::kappa_, kappa); }
  constexpr Case friction_force(double beta) const { return with(&Case::beta_, beta); }
  constexpr Case vibration_sign(double sigma) const { return with(&Case::sigma_, sigma); }
  constexpr Case damping(double d) const { return with(&Case::d_, d); }
  constexpr Case stiffness(double k) const { return with(&Case::k_, k); }
  constexpr Case mass_ratio(double eps) const { return with(&Case::eps_, eps); }
  constexpr Case load_damping(double d) const { return with(&Case::load_d_, d); }
  constexpr Case load_stiffness(double k) const { return with(&Case::load_k_, k); }

  template <class Law, class Damping, class Drive, class Sliding>
  constexpr operator Model<Law, Damping, Drive, Sliding>() const {
    using Scalar = typename Law::Scalar;
    static_assert(!Law::varies || std::is_same_v<Law, friction::Dahl<Scalar>>,
                  "other laws have numbers of their own: see of()");
    Model<Law, Damping, Drive, Sliding> model{};
    if constexpr (Law::varies) {
      model.law.contact_stiffness = static_cast<Scalar>(kappa_);
    }
    complete(model);
    return model;
  }

  /// With a law that brings its own numbers.
  template <class Law>
  constexpr Model<Law, Damped<typename Law::Scalar>, CosineDrive> of(const Law& law) const {
    return composed<Model<Law, Damped<typename Law::Scalar>, CosineDrive>>(law);
  }
  /// With a load as well.
  template <class Law>
  constexpr LoadedModel<Law, Damped<typename Law::Scalar>, CosineDrive> loaded(
      const Law& law) const {
    using Scalar = typename Law::Scalar;
    auto model = composed<LoadedModel<Law, Damped<Scalar>, CosineDrive>>(law);
    model.mass_ratio = static_cast<Scalar>(eps_);
    model.load_damping = static_cast<Scalar>(load_d_);
    model.load_stiffness = static_cast<Scalar>(load_k_);
    return model;
  }

 private:
  template <class Composed, class Law>
  constexpr Composed composed(const Law& law) const {
    Composed model{};
    if constexpr (!std::is_same_v<Law, friction::None<typename Law::Scalar>>) {
      model.law = law;
    }
    complete(model);
    return model;
  }
  template <class Law, class Damping, class Drive, class Sliding>
  constexpr void complete(Model<Law, Damping, Drive, Sliding>& model) const {
    using Scalar = typename Law::Scalar;
    if constexpr (!std::is_same_v<Law, friction::None<Scalar>>) {
      model.friction_force = static_cast<Scalar>(beta_);
    }
    if constexpr (Law::reverses) {
      model.vibration_sign = static_cast<Scalar>(sigma_);
    }
    if constexpr (!std::is_empty_v<Damping>) {
      model.damping = static_cast<Scalar>(d_);
    }
    model.stiffness = static_cast<Scalar>(k_);
  }

  constexpr Case with(double Case::*member, double value) const {
    Case changed = *this;
    changed.*member = value;
    return changed;
  }

  double kappa_ = 0.0;
  double beta_ = 0.0;
  double sigma_ = 1.0;
  double d_ = 0.0;
  double k_ = 0.0;
  double eps_ = 1.0;
  double load_d_ = 0.0;
  double load_k_ = 0.0;
};

}  // namespace sonoglide::plant
