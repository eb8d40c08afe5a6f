/// Values as C++ initialises them.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>

#include "firmware/friction/inverse_table.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::emulated {

/// Writes a value as the initialiser of a variable of its type, bit for bit: a number, an array, a
/// numeric::Split, or a structure that lists its fields (see control::Parts).
///
/// @tparam Scalar  the type that the written code calls so
template <class Scalar>
class Initialiser {
 public:
  static std::string of(float value) { return fmt::format("{:a}F", static_cast<double>(value)); }
  static std::string of(double value) { return fmt::format("{:a}", value); }

  template <class Integer>
  static std::enable_if_t<std::is_integral_v<Integer>, std::string> of(Integer value) {
    return fmt::format("{}", +value);
  }

  /// The header of the part that has it names the enumeration; the number is cast to it.
  static std::string of(friction::InverseForm form) {
    return fmt::format("friction::InverseForm{{{}}}", static_cast<int>(form));
  }

  template <class Storage, int FractionBits, class Overflow>
  static std::string of(numeric::Fixed<Storage, FractionBits, Overflow> value) {
    using Number = decltype(value);
    static_assert(std::is_same_v<Number, Scalar> ||
                  std::is_same_v<Number, numeric::Accumulator<Scalar>>);
    const bool scalar = std::is_same_v<Number, Scalar>;
    return fmt::format("{}::from_raw({})", scalar ? "Scalar" : "numeric::Accumulator<Scalar>",
                       value.raw());
  }

  /// Elements in braces need a second pair around them all.
  template <class Element, std::size_t Size>
  static std::string of(const std::array<Element, Size>& values) {
    List list;
    for (const Element& value : values) {
      list("", value);
    }
    return std::is_class_v<Element> && list.text[1] == '{' ? fmt::format("{{{}}}", list.closed())
                                                           : list.closed();
  }

  static std::string of(const numeric::Split<Scalar>& value) {
    return fmt::format("{{{}, {}}}", of(value.mantissa), of(value.exponent));
  }

  template <class Structure>
  static std::enable_if_t<std::is_class_v<Structure>, std::string> of(const Structure& structure) {
    List list;
    if constexpr (!std::is_empty_v<Structure>) {
      Structure::fields(structure, list);
    }
    return list.closed();
  }

 private:
  struct List {
    std::string text = "{";

    template <class Field>
    void operator()(const char* /*name*/, const Field& field) {
      text += (text.size() > 1 ? ", " : "") + of(field);
    }
    std::string closed() const { return text + "}"; }
  };
};

}  // namespace sonoglide::emulated
