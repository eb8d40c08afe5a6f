#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/process/serial_port.hpp"
#include "host_sim/unit/console.hpp"
#include "host_sim/unit/unit_link.hpp"

namespace sonoglide::cli {
namespace {

using std::chrono_literals::operator""ms;

struct ConnectOptions {
  std::string device;
  bool quiet = false;
};

/// Lines as they are typed or come through a pipe.
class TypedLines {
 public:
  /// Waits for a line, and calls something meanwhile.
  /// @return false at the end of the input
  template <class Meanwhile>
  bool next(std::string& line, const Meanwhile& meanwhile) {
    // A unit takes its host for silent after a tenth of a second.
    constexpr auto interval = 25ms;
    for (std::size_t end = text_.find('\n'); end == std::string::npos; end = text_.find('\n')) {
      if (!process::wait_for_input(STDIN_FILENO, interval)) {
        meanwhile();
        continue;
      }
      char bytes[256];
      const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
      if (count <= 0) {
        line = std::exchange(text_, {});
        return !line.empty();
      }
      text_.append(bytes, static_cast<std::size_t>(count));
    }
    const std::size_t end = text_.find('\n');
    line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return true;
  }

 private:
  std::string text_;
};

void print(const std::string& line) {
  fmt::print("{}\n", process::printable(line));
  std::fflush(stdout);
}

/// @throws process::ProcessError  the device is absent, silent or no unit; or commands of a script
///         were refused
void connect(const ConnectOptions& options) {
  process::SerialPort port(options.device);
  unit::UnitLink link(port);
  unit::Console console(link);
  const bool typed = isatty(STDIN_FILENO) == 1;
  if (typed && !options.quiet) {
    print(console.identity());
    print("connected; help lists the commands, Ctrl-D leaves");
  }
  TypedLines lines;
  const auto print_rows = [&] {
    for (const std::string& row : console.take_rows()) {
      print(row);
    }
  };
  const auto tell_news = [&] {
    print_rows();
    const std::string news = console.tell_news();
    if (!news.empty() && !options.quiet) {
      print(news);
    }
  };
  for (std::string line; lines.next(line, tell_news);) {
    for (const std::string& answer : console.carry_out(line)) {
      print(answer);
    }
    print_rows();
  }
  if (!typed && console.refused() > 0) {
    throw process::ProcessError(fmt::format("{}: commands that were not carried out: {}",
                                            process::printable(options.device), console.refused()));
  }
}

}  // namespace

void add_connect_command(CLI::App& program) {
  const auto options = std::make_shared<ConnectOptions>();
  CLI::App* command = program.add_subcommand(
      "connect", "Talk to a running unit: commands are lines of the standard input");
  command->add_option("device", options->device, "Serial device of the unit")
      ->required()
      ->type_name("DEVICE");
  command->add_flag("--quiet", options->quiet, "Prints the answers to commands alone");
  command->callback([options] { connect(*options); });
}

}  // namespace sonoglide::cli
