#include "host_sim/pil/image_control.hpp"

#include <fmt/format.h>

namespace sonoglide::pil {
namespace {

constexpr std::chrono::seconds patience{10};

}  // namespace

ImageControl::ImageControl(const std::vector<std::string>& command,
                           const process::Attention& attention)
    : image_(command, patience, attention) {}

void ImageControl::set_target(double /*friction_ratio*/) {}

hal::Drive ImageControl::exchange(const hal::Sample& sample) {
  const hal::Drive drive = image_.exchange(sample);
  if (exchanges_++ == 0) {
    first_answer_ = Clock::now();
  }
  return drive;
}

std::vector<numeric::SignalRecord> ImageControl::signals() const {
  return {};
}

std::optional<double> ImageControl::shut_down() {
  const std::chrono::duration<double> time = Clock::now() - first_answer_;
  const int code = image_.shut_down();
  if (code != 0) {
    throw EmulatorError(fmt::format("the image left with exit code {}", code));
  }
  if (exchanges_ < 2) {
    return std::nullopt;
  }
  return static_cast<double>(exchanges_ - 1) / time.count();
}

}  // namespace sonoglide::pil
