#include "host_sim/cli/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace sonoglide::cli {
namespace {

constexpr std::chrono::milliseconds redraw_interval{100};
constexpr int width = 30;
/// Erases from the cursor to the end of the line (ECMA-48).
constexpr const char* erase_line = "\r\x1b[K";

std::string remaining(double fraction, double elapsed_s) {
  const double left_s = std::ceil(elapsed_s * (1.0 - fraction) / fraction);
  if (left_s < 60.0) {
    return fmt::format("{:.0f} s left", left_s);
  }
  if (left_s < 3600.0) {
    return fmt::format("{:.0f} min left", std::ceil(left_s / 60.0));
  }
  return fmt::format("{:.1f} h left", left_s / 3600.0);
}

}  // namespace

std::string progress_line(double fraction, double elapsed_s) {
  const double part = fraction > 0.0 ? std::min(fraction, 1.0) : 0.0;
  const auto filled = static_cast<std::size_t>(part * width);
  std::string line = fmt::format("[{}{}] {:3.0f} %", std::string(filled, '#'),
                                 std::string(width - filled, '-'), std::floor(100.0 * part));
  // An estimate from less than this is noise.
  constexpr double least_part = 1e-3;
  if (part > least_part && part < 1.0) {
    line += ", " + remaining(part, elapsed_s);
  }
  return line;
}

ProgressBar::ProgressBar(std::FILE* stream, bool wanted)
    : stream_(stream), shown_(wanted && isatty(fileno(stream)) == 1) {}

ProgressBar::~ProgressBar() {
  if (drawn_) {
    std::fputs(erase_line, stream_);
    std::fflush(stream_);
  }
}

void ProgressBar::update(double fraction) {
  if (!shown_) {
    return;
  }
  const Clock::time_point now = Clock::now();
  if (drawn_ && now - last_drawn_ < redraw_interval) {
    return;
  }
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  fmt::print(stream_, "{}{}", erase_line, progress_line(fraction, elapsed_s));
  std::fflush(stream_);
  drawn_ = true;
  last_drawn_ = now;
}

}  // namespace sonoglide::cli
