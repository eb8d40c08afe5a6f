#include "host_sim/cli/progress_bar.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace sonoglide::cli {
namespace {

constexpr std::chrono::milliseconds redraw_interval{100};
constexpr int widest_bar = 30;
constexpr int narrowest_bar = 5;
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

bool can_erase_a_line(const char* terminal) {
  return terminal != nullptr && *terminal != '\0' && std::strcmp(terminal, "dumb") != 0;
}

int columns_of(std::FILE* stream) {
  constexpr int usual = 80;
  winsize size{};
  return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

}  // namespace

std::string progress_line(double fraction, double elapsed_s, int columns) {
  const double part = fraction > 0.0 ? std::min(fraction, 1.0) : 0.0;
  const std::string percent = fmt::format("{:3.0f} %", std::floor(100.0 * part));
  // An estimate from less than this is noise.
  constexpr double least_part = 1e-3;
  std::string rest;
  if (part > least_part && part < 1.0) {
    rest = ", " + remaining(part, elapsed_s);
  }
  const auto room_beside = [&](const std::string& text) {
    constexpr int brackets_and_blank = 3;
    return columns - 1 - brackets_and_blank - static_cast<int>(text.size());
  };
  if (room_beside(percent + rest) < narrowest_bar) {
    rest.clear();
  }
  const int room = room_beside(percent);
  if (room < narrowest_bar) {
    return columns > static_cast<int>(percent.size()) ? percent : std::string();
  }
  const auto width = static_cast<std::size_t>(std::min(widest_bar, room_beside(percent + rest)));
  const auto filled = static_cast<std::size_t>(part * static_cast<double>(width));
  return fmt::format("[{}{}] {}{}", std::string(filled, '#'), std::string(width - filled, '-'),
                     percent, rest);
}

ProgressBar::ProgressBar(std::FILE* stream, bool wanted)
    : stream_(stream),
      shown_(wanted && isatty(fileno(stream)) == 1 && can_erase_a_line(std::getenv("TERM"))),
      erased_([this] { erase_at_once(); }) {}

ProgressBar::~ProgressBar() {
  if (drawn_) {
    std::fputs(erase_line, stream_);
    std::fflush(stream_);
  }
}

/// Past the stream, whose lock the drawing thread may hold.
void ProgressBar::erase_at_once() const {
  const std::string_view line = erase_line;
  if (drawn_ && ::write(fileno(stream_), line.data(), line.size()) < 0) {
    return;  // nobody can be told
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
  std::fputs(erase_line, stream_);
  std::fputs(progress_line(fraction, elapsed_s, columns_of(stream_)).c_str(), stream_);
  std::fflush(stream_);
  drawn_ = true;
  last_drawn_ = now;
}

}  // namespace sonoglide::cli
