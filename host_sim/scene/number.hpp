/// A number as the option `--set KEY=NUMBER` gives it.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <variant>

namespace sonoglide::scene {

/// Whether a number is written without a point or an exponent, so that TOML takes it for an
/// integer: a whole one of a magnitude below 1e16, as fmt has it.
bool is_written_whole(double number);

/// An integer where it is written whole, a real number otherwise.
class Number {
 public:
  explicit Number(double number);

  const toml::node& node() const {
    return std::visit([](const toml::node& value) -> const toml::node& { return value; }, value_);
  }

 private:
  std::variant<toml::value<std::int64_t>, toml::value<double>> value_;
};

}  // namespace sonoglide::scene
