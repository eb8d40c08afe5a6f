#include "host_sim/boards/emulated/initialiser.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "firmware/control/controller.hpp"
#include "firmware/control/feedback/contact_foresight.hpp"
#include "firmware/control/feedback/contact_lead.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/limits/drive_limit.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/sample_inspection.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "firmware/plant/strang/fixed_point_strang.hpp"
#include "host_sim/boards/emulated/part_text.hpp"

namespace sonoglide::emulated::initialiser_test {
namespace {

/// Stands for any member of an aggregate.
struct Anything {
  template <class Member>
  operator Member() const;  // NOLINT(google-explicit-constructor)
};

template <std::size_t /*Index*/>
using AnythingAt = Anything;

template <class Aggregate, class Indices, class = void>
struct Takes : std::false_type {};
template <class Aggregate, std::size_t... Index>
struct Takes<Aggregate, std::index_sequence<Index...>,
             std::void_t<decltype(Aggregate{AnythingAt<Index>{}...})>> : std::true_type {};

/// How many members can be initialised.
template <class Aggregate, std::size_t Count = 0>
constexpr std::size_t member_count() {
  if constexpr (Takes<Aggregate, std::make_index_sequence<Count + 1>>::value) {
    return member_count<Aggregate, Count + 1>();
  } else {
    return Count;
  }
}

/// Visits every number of a structure, and changes one of them.
class Change {
 public:
  explicit Change(std::size_t which) : which_(which) {}

  bool made() const { return seen_ > which_; }

  template <class Number>
  std::enable_if_t<std::is_arithmetic_v<Number>> operator()(const char* /*name*/, Number& number) {
    if (seen_++ == which_) {
      number = static_cast<Number>(number + 1);
    }
  }

  template <class Storage, int FractionBits, class Overflow>
  void operator()(const char* /*name*/, numeric::Fixed<Storage, FractionBits, Overflow>& number) {
    Storage raw = number.raw();
    (*this)("", raw);
    number = number.from_raw(raw);
  }

  template <class Element, std::size_t Size>
  void operator()(const char* /*name*/, std::array<Element, Size>& elements) {
    for (Element& element : elements) {
      (*this)("", element);
    }
  }

  template <class Scalar>
  void operator()(const char* /*name*/, numeric::Split<Scalar>& split) {
    (*this)("", split.mantissa);
    (*this)("", split.exponent);
  }

  template <class Structure>
  std::enable_if_t<std::is_class_v<Structure>> operator()(const char* name, Structure& structure) {
    if constexpr (!std::is_empty_v<Structure>) {
      list_fields(name, structure);
    }
  }

 private:
  template <class Structure>
  void list_fields(const char* name, Structure& structure) {
    std::size_t fields = 0;
    Structure::fields(structure, [&](const char* /*name*/, auto& /*field*/) { ++fields; });
    EXPECT_EQ(fields, member_count<Structure>()) << "not every field is listed: " << name;
    Structure::fields(structure, *this);
  }

  std::size_t which_;
  std::size_t seen_ = 0;
};

/// Each number changed alone gives another text than all the other changes.
/// @return how many numbers there are
template <class Scalar, class Structure>
std::size_t expect_every_number_in_text() {
  std::set<std::string> texts{Initialiser<Scalar>::of(Structure{})};
  for (std::size_t which = 0;; ++which) {
    Structure structure{};
    Change change(which);
    change("", structure);
    if (!change.made()) {
      return which;
    }
    EXPECT_TRUE(texts.insert(Initialiser<Scalar>::of(structure)).second) << "number " << which;
  }
}

template <class S>
using EveryPart =
    control::Parts<S, control::LearntFriction<S>, control::DahlFeedforward<S>,
                   control::SlewLimit<S>, control::NotchShaper<S, 4>,
                   control::IntegralRegulator<S, 4>, control::PeriodicRelearning<S>,
                   control::FedForward<S>, control::ForceSensor, control::ForceTarget<S>,
                   control::DriveLimit<S>, control::TolerantSamples>;

template <class Scalar>
class InitialiserOf : public testing::Test {};
using Scalars = testing::Types<float, double, numeric::Q31<numeric::Saturating>,
                               numeric::Q15<numeric::Saturating>>;
TYPED_TEST_SUITE(InitialiserOf, Scalars);

TYPED_TEST(InitialiserOf, WritesEveryParameterOfAController) {
  using Parameters = typename control::Controller<EveryPart<TypeParam>>::Parameters;
  EXPECT_EQ((expect_every_number_in_text<TypeParam, Parameters>()), 39U);
}

TYPED_TEST(InitialiserOf, WritesTheLeadOfASlowContactAndItsRegulator) {
  using Integral = control::IntegralRegulator<TypeParam, 4>;
  using Alone = control::NoFeedback<TypeParam>;
  EXPECT_EQ((expect_every_number_in_text<TypeParam,
                                         typename control::ContactLead<Integral>::Parameters>()),
            7U);
  EXPECT_EQ(
      (expect_every_number_in_text<TypeParam,
                                   typename control::ContactForesight<Integral>::Parameters>()),
      10U);
  EXPECT_EQ(
      (expect_every_number_in_text<TypeParam, typename control::ContactLead<Alone>::Parameters>()),
      2U);
}

TEST(Initialiser, NamesTheRegulatorInALead) {
  using Integral = control::IntegralRegulator<float, 4>;
  typename control::ContactLead<Integral>::Parameters parameters{};
  parameters.regulator.delay_periods = 3;
  const PartText text = part_text(configure::Type<control::ContactLead<Integral>>{}, parameters);
  EXPECT_EQ(text.type, "ContactLead<control::IntegralRegulator<Scalar, 3>>");
  EXPECT_EQ(text.headers.size(), 2U);
  EXPECT_EQ(part_text(configure::Type<control::ContactLead<control::NoFeedback<float>>>{},
                      control::ContactLead<control::NoFeedback<float>>::Parameters{})
                .type,
            "ContactLead<control::NoFeedback<Scalar>>");
  using Foreseen = control::ContactForesight<Integral>;
  EXPECT_EQ(part_text(configure::Type<Foreseen>{},
                      Foreseen::Parameters{parameters.regulator, {}, {}, {}, {}})
                .type,
            "ContactForesight<control::IntegralRegulator<Scalar, 3>>");
}

TYPED_TEST(InitialiserOf, WritesEveryTapOfARobustNotch) {
  using Parameters = typename control::NotchShaper<TypeParam, 4, 5>::Parameters;
  EXPECT_EQ((expect_every_number_in_text<TypeParam, Parameters>()), 6U);
}

TEST(Initialiser, WritesEveryParameterOfAPlantInIntegers) {
  EXPECT_EQ((expect_every_number_in_text<std::int32_t, plant::FixedStrangParameters>()),
            4U + 2U * 32U + 6U + 3U);
}

TEST(Initialiser, IsTheNumberBitForBit) {
  using Q15 = numeric::Q15<numeric::Saturating>;
  using Q31 = numeric::Q31<numeric::Saturating>;
  EXPECT_EQ(Initialiser<float>::of(0.1F), "0x1.99999ap-4F");
  EXPECT_EQ(Initialiser<double>::of(-0.1), "-0x1.999999999999ap-4");
  EXPECT_EQ(Initialiser<Q15>::of(Q15::from_raw(-3)), "Scalar::from_raw(-3)");
  EXPECT_EQ(Initialiser<Q15>::of(Q31::from_raw(3)), "numeric::Accumulator<Scalar>::from_raw(3)");
  EXPECT_EQ(Initialiser<Q31>::of(Q31::from_raw(3)), "Scalar::from_raw(3)");
  EXPECT_EQ(Initialiser<float>::of(std::uint8_t{65}), "65");
}

// std::array holds an array: the outer braces of one that holds others cannot be left out.
TEST(Initialiser, NestsArrays) {
  using Row = std::array<int, 2>;
  EXPECT_EQ(Initialiser<int>::of(Row{1, 2}), "{1, 2}");
  EXPECT_EQ(Initialiser<int>::of(std::array<Row, 2>{Row{1, 2}, Row{3, 4}}), "{{{1, 2}, {3, 4}}}");
}

}  // namespace
}  // namespace sonoglide::emulated::initialiser_test
