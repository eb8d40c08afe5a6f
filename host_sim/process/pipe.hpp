/// Descriptors with an owner, pipes, and waiting for what comes through them.
#pragma once

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace sonoglide::process {

/// what() names the program and the reason.
class ProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Closes what it holds; movable, never copied.
class Descriptor {
 public:
  Descriptor() = default;
  /// @param number  negative: nothing is held
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int number() const { return number_; }

  void close() {
    if (number_ >= 0) {
      ::close(number_);
      number_ = -1;
    }
  }

 private:
  int number_ = -1;
};

struct Pipe {
  Descriptor read_end;
  Descriptor write_end;
};

/// @throws ProcessError  no descriptors are left
Pipe make_pipe();

/// Puts a file that can be neither read nor written, as it should be, in the place of each standard
/// stream that is closed: else the next file that is opened would be taken for it.
void fill_closed_streams();

/// Whether an open file still stands under its name.
bool stands(const Descriptor& file, const std::filesystem::path& path);

/// Takes a lock on an open file, as flock does. @return false where it has none, or another has it
bool lock(const Descriptor& file, int operation);

/// A file that only this process and its children have, in memory, to be read from its beginning.
/// Unlike a pipe it takes everything at once.
/// @throws ProcessError  no memory or no descriptors are left
Descriptor make_memory_file(std::string_view content = {});

/// What stands in such a file, its last `most_bytes` bytes at most.
std::string memory_file_text(const Descriptor& file, std::size_t most_bytes);

/// @param limit  waits this long at most
/// @return whether there is something to read, the end included
bool wait_for_input(int descriptor, std::chrono::milliseconds limit);

}  // namespace sonoglide::process
