#include "host_sim/process/serial_port.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "host_sim/process/printable.hpp"

namespace sonoglide::process {

using std::chrono_literals::operator""ms;

namespace {

/// Without waiting for a modem's carrier. No file has a name with a byte 0, at which the system would end it.
int opened(const std::string& device) {
  if (device.find('\0') != std::string::npos) {
    errno = ENOENT;
    return -1;
  }
  return open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
}

}  // namespace

SerialPort::SerialPort(const std::string& device) : device_(device), line_(opened(device)) {
  if (line_.number() < 0) {
    fail(std::strerror(errno));
  }
  if (!lock(line_, LOCK_EX | LOCK_NB)) {
    fail("is used by another program");
  }
  termios settings{};
  if (tcgetattr(line_.number(), &settings) != 0) {
    fail("is no serial line");
  }
  cfmakeraw(&settings);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cflag |= CLOCAL | CREAD;
  cfsetspeed(&settings, B115200);
  if (tcsetattr(line_.number(), TCSANOW, &settings) != 0) {
    fail(std::strerror(errno));
  }
  tcflush(line_.number(), TCIFLUSH);
}

void SerialPort::send(const std::uint8_t* bytes, std::size_t size) {
  while (size > 0) {
    pollfd room{line_.number(), POLLOUT, 0};
    if (poll(&room, 1, 1000) == 0) {
      fail("takes nothing");
    }
    const ssize_t count = write(line_.number(), bytes, size);
    if (count < 0 && errno != EAGAIN && errno != EINTR) {
      fail(std::strerror(errno));
    }
    const auto sent = static_cast<std::size_t>(count < 0 ? 0 : count);
    bytes += sent;
    size -= sent;
  }
}

void SerialPort::drain(std::chrono::milliseconds limit) const {
  const auto end = std::chrono::steady_clock::now() + limit;
  int waiting = 0;
  while (ioctl(line_.number(), TIOCOUTQ, &waiting) == 0 && waiting > 0 &&
         std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(1ms);
  }
}

std::size_t SerialPort::receive(std::uint8_t* bytes, std::size_t size,
                                std::chrono::milliseconds limit) {
  if (!wait_for_input(line_.number(), limit)) {
    return 0;
  }
  const ssize_t count = read(line_.number(), bytes, size);
  if (count > 0) {
    return static_cast<std::size_t>(count);
  }
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return 0;
  }
  fail(count == 0 ? "was closed at its other end" : std::strerror(errno));
}

void SerialPort::fail(const std::string& reason) const {
  throw ProcessError(printable(device_) + ": " + reason);
}

}  // namespace sonoglide::process
