/// A controller in the field: what may be asked of it, over a link or a console.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/app/field_parameters.hpp"
#include "firmware/app/store/two_page_store.hpp"
#include "firmware/app/supervisor.hpp"

namespace sonoglide::app {

/// How a request was taken.
enum class Answer : std::uint8_t {
  taken,  ///< done; a parameter: being saved, see Unit::proceed()
  out_of_range,
  unknown_parameter,
  drive_not_stopped,
};

/// Supervised controller, parameters and their store. Nothing here waits.
template <class PartsT, class Flash>
class Unit {
 public:
  using Design = FieldDesign<PartsT>;
  using Supervisor = app::Supervisor<typename Design::Controller>;

  /// Takes the parameters from the store, or as compiled in where it holds none for this design.
  /// @param design  outlives the unit, as the flash does.
  Unit(const FieldDesign<PartsT>& design, Flash& flash)
      : design_(design),
        store_(flash, design.layout()),
        values_(design.presets()),
        origin_(load()),
        target_(value(Parameter::target)),
        supervisor_(design.controller_parameters(values_)) {
    supervisor_.set_target(design_.half_target(target_));
  }

  Supervisor& supervisor() { return supervisor_; }
  const Supervisor& supervisor() const { return supervisor_; }

  /// Where the parameters came from at reset.
  store::Origin origin() const { return origin_; }

  /// In force from the next carrier period on, until reset.
  /// @param ratio  friction ratio, millionths.
  Answer set_target(std::uint32_t ratio) {
    if (!info(Parameter::target).allows(ratio)) {
      return Answer::out_of_range;
    }
    target_ = ratio;
    supervisor_.set_target(design_.half_target(ratio));
    return Answer::taken;
  }

  /// Friction ratio, millionths.
  std::uint32_t target() const { return target_; }

  const ParameterInfo& info(std::size_t parameter) const { return design_.info(parameter); }
  const ParameterInfo& info(Parameter parameter) const {
    return info(static_cast<std::size_t>(parameter));
  }
  std::uint32_t value(std::size_t parameter) const { return values_[parameter]; }
  std::uint32_t value(Parameter parameter) const {
    return value(static_cast<std::size_t>(parameter));
  }

  /// Begins to save a value; it is in force when it is safe. Refused, it changes nothing. Until
  /// proceed() has come to an end, no other request may be made.
  Answer write(std::size_t parameter, std::uint32_t value) {
    if (parameter >= parameter_count) {
      return Answer::unknown_parameter;
    }
    if (!info(parameter).allows(value)) {
      return Answer::out_of_range;
    }
    if (supervisor_.driving()) {
      return Answer::drive_not_stopped;
    }
    pending_ = values_;
    pending_[parameter] = value;
    pending_parameter_ = parameter;
    store_.save(pending_);
    return Answer::taken;
  }

  /// The next step of a save; of the flash, at most one operation.
  store::Saving proceed() {
    const store::Saving saving = store_.proceed();
    if (saving == store::Saving::saved) {
      adopt();
    }
    return saving;
  }

 private:
  store::Origin load() {
    ParameterValues stored{};
    const store::Origin origin = store_.load(stored);
    if (origin != store::Origin::stored) {
      return origin;
    }
    if (!design_.allows(stored)) {
      return store::Origin::damaged;
    }
    values_ = stored;
    return origin;
  }

  void adopt() {
    values_ = pending_;
    supervisor_.reconfigure(design_.controller_parameters(values_));
    if (pending_parameter_ == static_cast<std::size_t>(Parameter::target)) {
      target_ = value(Parameter::target);
    }
    supervisor_.set_target(design_.half_target(target_));
  }

  const Design& design_;
  store::TwoPageStore<Flash, parameter_count> store_;
  ParameterValues values_;
  store::Origin origin_;
  std::uint32_t target_;
  ParameterValues pending_{};
  std::size_t pending_parameter_ = 0;
  Supervisor supervisor_;
};

}  // namespace sonoglide::app
