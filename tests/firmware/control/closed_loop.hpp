/// A controller around a contact that always stands on its steady friction-ratio map.
#pragma once

#include <cstddef>
#include <deque>

#include "design.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// The true contact, per unit as the controller's numbers are.
struct Contact {
  double friction_force = 0.5;
  double contact_force = 1.0108;
  double gain = 1.0;  ///< true over nominal vibration

  /// Friction ratio at a drive amplitude and a sliding speed > 0.
  double ratio(double amplitude, double speed) const {
    if (amplitude <= 0.0) {
      return 1.0;
    }
    const double vibration = gain * amplitude;
    return friction::dahl_friction_ratio(speed / vibration,
                                         contact_force * vibration / friction_force);
  }
};

template <class PartsT>
class ClosedLoop {
 public:
  using Scalar = typename PartsT::Scalar;

  explicit ClosedLoop(const Design& design, const Contact& contact = {})
      : controller(parameters<PartsT>(design)), contact_(contact) {
    controller.start();
  }

  void set_target(double ratio) { controller.set_target(numeric::from_real<Scalar>(0.5 * ratio)); }

  /// The sensor shows the force of so many periods ago; before the first there is none.
  void delay_sensor(std::size_t periods) { pipeline_.assign(periods, contact_.friction_force); }

  /// What the sensor shows of the period just driven.
  Measurement<Scalar> measurement(double velocity, double noise = 0.0) {
    const double speed = velocity < 0.0 ? -velocity : velocity;
    ratio_ = contact_.ratio(amplitude(), speed);
    const double force = contact_.friction_force * ratio_ + noise;
    pipeline_.push_back(velocity < 0.0 ? -force : force);
    const double shown = pipeline_.front();
    pipeline_.pop_front();
    return {numeric::from_real<Scalar>(shown), numeric::from_real<Scalar>(velocity), Quality::good};
  }

  /// The contact's friction force from here on.
  void set_friction_force(double force) { contact_.friction_force = force; }

  /// One period: the contact answers the last command, the controller the contact.
  const DriveCommand<Scalar>& step(double velocity = 0.1, double noise = 0.0) {
    return answer(measurement(velocity, noise));
  }

  const DriveCommand<Scalar>& answer(const Measurement<Scalar>& measured) {
    command_ = controller.step(measured);
    return command_;
  }

  const DriveCommand<Scalar>& run(int periods, double velocity = 0.1) {
    for (int i = 0; i < periods; ++i) {
      step(velocity);
    }
    return command_;
  }

  const DriveCommand<Scalar>& command() const { return command_; }
  double amplitude() const { return numeric::to_real(command_.amplitude); }
  /// Friction ratio of the last period.
  double ratio() const { return ratio_; }

  Controller<PartsT> controller;

 private:
  Contact contact_;
  std::deque<double> pipeline_;
  DriveCommand<Scalar> command_{};
  double ratio_ = 1.0;
};

}  // namespace sonoglide::control
