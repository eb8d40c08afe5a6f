#include "host_sim/emulated/emulated_unit.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

namespace sonoglide::emulated {

EmulatedUnit::EmulatedUnit(const EmulatedBoard& board, const std::filesystem::path& image)
    : nothing_(open("/dev/null", O_RDONLY | O_CLOEXEC)),
      said_(process::make_pipe()),
      complaints_(process::make_memory_file()),
      emulator_(unit_emulator_command(board, image.string()),
                {nothing_.number(), said_.write_end.number(), complaints_.number()}, SIGKILL) {
  said_.write_end.close();
  device_ = await_device();
}

/// The emulator names it once the board runs.
std::string EmulatedUnit::await_device() {
  constexpr std::chrono::seconds patience{60};  // for each piece, on a busy machine
  const std::string begin = "redirected to ";
  std::string text;
  char byte = 0;
  while (process::wait_for_input(said_.read_end.number(), patience) &&
         read(said_.read_end.number(), &byte, 1) == 1) {
    text += byte;
    const std::size_t at = text.find(begin);
    if (at != std::string::npos && byte == ' ' && text.size() > at + begin.size()) {
      return text.substr(at + begin.size(), text.size() - 1 - at - begin.size());
    }
  }
  constexpr std::size_t most_bytes = 2000;
  throw process::ProcessError(fmt::format("the emulator names no serial device; it said:\n{}{}",
                                          text,
                                          process::memory_file_text(complaints_, most_bytes)));
}

}  // namespace sonoglide::emulated
