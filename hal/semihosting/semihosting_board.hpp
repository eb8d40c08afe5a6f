/// A board in lockstep over semihosting, the same on every board.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/frame.hpp"
#include "hal/semihosting/semihosting.hpp"
#include "hal/start/image_end.hpp"

namespace sonoglide::hal::semihosting {

/// Joins a board to the standard input and output of its emulator; where these cannot be opened,
/// the image ends (ExitCode::link_broken).
class Link {
 public:
  Link() {
    if (input_ < 0 || output_ < 0) {
      leave_image(static_cast<int>(lockstep::ExitCode::link_broken));
    }
  }

  std::size_t read(std::uint8_t* bytes, std::size_t size) { return read_all(input_, bytes, size); }
  bool write(const std::uint8_t* bytes, std::size_t size) {
    return write_all(output_, bytes, size);
  }

 private:
  std::int32_t input_ = open_standard_input();
  std::int32_t output_ = open_standard_output();
};

using SemihostingBoard = lockstep::LockstepBoard<Link, lockstep::ProcessorCounter>;

}  // namespace sonoglide::hal::semihosting
