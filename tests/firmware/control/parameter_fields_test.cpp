/// What writes parameters into an image names each field of each part: none is left out, in the order of memory.

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>

#include "design.hpp"
#include "firmware/control/feedback/adaptive_regulator.hpp"
#include "firmware/control/feedback/contact_foresight.hpp"
#include "firmware/control/feedback/contact_lead.hpp"
#include "firmware/control/friction/friction_tracking.hpp"
#include "firmware/control/friction/tabulated_feedforward.hpp"
#include "firmware/control/limits/current_limit.hpp"
#include "firmware/control/limits/sample_inspection.hpp"
#include "firmware/control/target.hpp"
#include "firmware/control/vibration/biased_damping.hpp"
#include "firmware/control/vibration/damped_vibration.hpp"
#include "firmware/control/vibration/reading_lag.hpp"
#include "firmware/control/vibration/resonant_vibration.hpp"
#include "firmware/control/vibration/sensorless_vibration.hpp"

namespace sonoglide::control::parameter_fields_test {
namespace {

struct Ignore {
  template <class Field>
  void operator()(const char* /*name*/, Field& /*field*/) const {}
};

template <class Structure, class = void>
constexpr bool names_fields = false;
template <class Structure>
constexpr bool names_fields<
    Structure, std::void_t<decltype(Structure::fields(std::declval<Structure&>(), Ignore{}))>> =
    true;

/// Between two fields that follow each other is no room for a third but one that fills padding.
template <class Structure>
void expect_no_gap(Structure& structure, const std::string& path) {
  const auto* const begin = reinterpret_cast<const char*>(&structure);
  std::size_t end = 0;
  Structure::fields(structure, [&](const char* name, auto& field) {
    using Field = std::remove_reference_t<decltype(field)>;
    if (std::is_empty_v<Field>) {
      return;  // a base, and no room of its own
    }
    const auto at = static_cast<std::size_t>(reinterpret_cast<const char*>(&field) - begin);
    EXPECT_GE(at, end) << path << name << " is out of order";
    EXPECT_LT(at - end, alignof(Field)) << "a field is missing before " << path << name;
    end = at + sizeof(Field);
    if constexpr (names_fields<Field>) {
      expect_no_gap(field, path + name + ".");
    }
  });
  EXPECT_LT(sizeof(Structure) - end, alignof(Structure))
      << "a field is missing at the end of " << path;
}

template <class Part>
class ParameterFields : public testing::Test {};
using S = float;
using EveryPart =
    testing::Types<Controller<FullParts<S>>, AdaptiveRegulator<S, 2>,
                   ContactForesight<AdaptiveRegulator<S, 2>>, TabulatedFeedforward<S>,
                   FrictionTracking<S>, ForceTarget<S>, TolerantSamples, DampedVibration<S, 2>,
                   BiasedDampedVibration<S, 2>, SensorlessVibration<S, 2, LaggingReading<S>>,
                   BiasedSensorlessVibration<S, 2, LaggingReading<S>>,
                   ResonantVibration<S, 2, CurrentLimit<S>>>;
TYPED_TEST_SUITE(ParameterFields, EveryPart);

TYPED_TEST(ParameterFields, AreAllNamedInTheirOrder) {
  typename TypeParam::Parameters parameters{};
  expect_no_gap(parameters, "");
}

}  // namespace
}  // namespace sonoglide::control::parameter_fields_test
