#include "host_sim/process/pipe.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

namespace sonoglide::process {

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw ProcessError(std::string("no pipe can be made: ") + std::strerror(errno));
  }
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0) {
      open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // the lowest that is free
    }
  }
}

bool stands(const Descriptor& file, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(file.number(), &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

bool lock(const Descriptor& file, int operation) {
  int outcome = 0;
  do {
    outcome = flock(file.number(), operation);
  } while (outcome != 0 && errno == EINTR);
  return outcome == 0;
}

Descriptor make_memory_file(std::string_view content) {
  Descriptor file(memfd_create("sonoglide", MFD_CLOEXEC));
  while (file.number() >= 0 && !content.empty()) {
    const ssize_t count = write(file.number(), content.data(), content.size());
    if (count < 0) {
      file.close();
    }
    content.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  }
  if (file.number() < 0) {
    throw ProcessError(std::string("no file can be made in memory: ") + std::strerror(errno));
  }
  lseek(file.number(), 0, SEEK_SET);
  return file;
}

std::string memory_file_text(const Descriptor& file, std::size_t most_bytes) {
  const auto size = static_cast<std::size_t>(lseek(file.number(), 0, SEEK_END));
  std::string text(std::min(size, most_bytes), '\0');
  const ssize_t count =
      pread(file.number(), text.data(), text.size(), static_cast<off_t>(size - text.size()));
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  return text;
}

bool wait_for_input(int descriptor, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  pollfd input{descriptor, POLLIN, 0};
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        end - std::chrono::steady_clock::now());
    const int ready = poll(&input, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (ready >= 0 || errno != EINTR) {
      return ready > 0;
    }
  }
}

}  // namespace sonoglide::process
